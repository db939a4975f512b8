// Connection: one farlight.v1 WebSocket, driven by the thread that calls it. It reads the next
// message only when the last one has been received, so a caller that does not call lets the server
// wait.
#pragma once

#include "protocol/codec.h"
#include "protocol/frame_header.h"

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace farlight::client {

/// An address that is none, a server that is not there, a handshake that fails, a connection that
/// breaks while sending.
struct ConnectionError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Url {
    std::string host;
    std::string port;
    std::string path;

    bool operator==(const Url&) const = default;
};

/// ws://HOST[:PORT][/PATH]; absent parts are port 80 and /ws. Throws std::invalid_argument.
Url parse_url(const std::string& text);

/// A frame as it came, its payload not yet decoded.
struct Frame {
    protocol::FrameHeader header;
    std::vector<std::byte> payload;
    std::chrono::steady_clock::time_point arrived;
};

/// The connection has ended.
struct Closed {
    std::uint16_t code = 0;  ///< WebSocket close code; 0 when the connection broke without one.
    std::string reason;
};

/// A DecodeError stands for a message that is not as PROTOCOL.md says; the connection goes on.
using Event = std::variant<protocol::ServerMessage, Frame, Closed, protocol::DecodeError>;

class Connection {
public:
    /// Connects and shakes hands. Throws ConnectionError, also when that takes longer than
    /// `timeout`.
    explicit Connection(
        const Url& url, std::chrono::milliseconds timeout = std::chrono::seconds(10));
    /// Drops the connection without a closing handshake; see close().
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Throws ConnectionError when the server does not take it.
    void send(const protocol::ClientMessage& message);
    /// Sends text as it is; for tests of servers.
    void send_text(const std::string& text);

    /// The next event, or nothing after `timeout`. After Closed, only Closed.
    std::optional<Event> receive(std::chrono::milliseconds timeout);

    /// Says bye and waits shortly for the closing handshake.
    void close();

private:
    struct Socket;
    std::unique_ptr<Socket> socket_;
};

/// "1008 (reason)" or "the connection broke".
std::string to_string(const Closed& closed);

}  // namespace farlight::client
