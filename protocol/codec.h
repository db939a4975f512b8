// JSON text <-> messages. Total functions: any bytes in, a message or a DecodeError out, never an
// exception.
#pragma once

#include "protocol/messages.h"

#include <string>
#include <string_view>
#include <variant>

namespace farlight::protocol {

/// Why bytes from a peer were refused.
struct DecodeError {
    ErrorCode code = ErrorCode::kNotJson;
    std::string field;  ///< Path of the field at fault, as `scene.bounds.lower`; empty for the
                        ///< whole message.
    std::string problem;  ///< "is missing", "is 9, expected 1 to 8" ...

    bool operator==(const DecodeError&) const = default;
};

template <typename T> using Decoded = std::variant<T, DecodeError>;

/// What a server understands of a text message. Longer than kMaxClientTextBytes is refused unread.
Decoded<ClientMessage> decode_client_message(std::string_view text);

/// What a client understands of a text message. Longer than kMaxServerTextBytes is refused unread.
Decoded<ServerMessage> decode_server_message(std::string_view text);

/// One JSON object on one line. Strings that are not UTF-8 get replacement characters.
std::string encode(const ClientMessage& message);
std::string encode(const ServerMessage& message);

/// "field problem", for logs and `error` messages.
std::string to_string(const DecodeError& error);

/// The `error` message a server answers with.
Error to_error_message(const DecodeError& error);

/// The format a wire word names, if any; so too for the other enumerations.
template <typename Enum> std::optional<Enum> from_name(std::string_view name)
{
    for (std::size_t i = 0; i < std::size(names_of(Enum{})); ++i)
        if (names_of(Enum{})[i] == name)
            return static_cast<Enum>(i);
    return std::nullopt;
}

}  // namespace farlight::protocol
