// JSON text <-> messages, driven by each message's each_field list.
#include "protocol/codec.h"

#include "protocol/message_reader.h"

#include <algorithm>

namespace farlight::protocol {
namespace {

/// Nesting of brackets outside strings; right for valid JSON, and an upper bound costs nobody
/// anything.
int nesting_depth(std::string_view text)
{
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\')
            ++i;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            deepest = std::max(deepest, ++depth);
        else if (!in_string && (c == '}' || c == ']'))
            --depth;
    }
    return deepest;
}

Decoded<Json> parse_object(std::string_view text, std::size_t longest)
{
    if (text.size() > longest)
        return DecodeError{ErrorCode::kTooLarge, "",
            "has " + std::to_string(text.size()) + " bytes, expected at most "
                + std::to_string(longest)};
    if (nesting_depth(text) > kMaxJsonDepth)
        return DecodeError{ErrorCode::kTooDeep, "",
            "nests deeper than " + std::to_string(kMaxJsonDepth) + " levels"};
    constexpr int kNumberOverflow = 406;  // nlohmann's id for a number beyond the range of double
    try {
        Json json = Json::parse(text);
        if (!json.is_object())
            return DecodeError{ErrorCode::kNotJson, "", "is not a JSON object"};
        return json;
    } catch (const Json::exception& problem) {
        if (problem.id == kNumberOverflow)
            return DecodeError{ErrorCode::kNotFinite, "", "holds a number that is not finite"};
        return DecodeError{ErrorCode::kNotJson, "", "is not JSON"};
    }
}

/// Rules between the fields of a pose.
void check(const Pose& pose, MessageReader& reader)
{
    if (pose.position == pose.target)
        reader.fail_at("target", ErrorCode::kOutOfRange, "equals position, expected another point");
    if (pose.up == std::array<double, 3>{0, 0, 0})
        reader.fail_at("up", ErrorCode::kOutOfRange, "is zero, expected a direction");
}
void check(const Camera& camera, MessageReader& reader)
{
    check(camera.pose, reader);
}
void check(const Set& set, MessageReader& reader)
{
    if (set.value.is_structured())
        reader.fail_at("value", ErrorCode::kWrongType,
            "has the wrong type, expected a string, number or boolean");
}
void check(const Edit& edit, MessageReader& reader)
{
    if (!edit.patch.is_object())
        reader.fail_at("patch", ErrorCode::kWrongType, "has the wrong type, expected an object");
}
void check(const auto&, MessageReader&) { }

template <typename Variant, std::size_t kIndex = 0>
Decoded<Variant> read_as(const std::string& type, const Json& json)
{
    if constexpr (kIndex == std::variant_size_v<Variant>) {
        return DecodeError{ErrorCode::kUnknownType, "type", "is unknown: " + type.substr(0, 64)};
    } else {
        using Message = std::variant_alternative_t<kIndex, Variant>;
        if (type != Message::kType)
            return read_as<Variant, kIndex + 1>(type, json);
        Message message;
        MessageReader reader;
        reader.read(json, message);
        if (!reader.error())
            check(message, reader);
        if (reader.error())
            return *reader.error();
        return Decoded<Variant>(
            std::in_place_type<Variant>, std::in_place_type<Message>, std::move(message));
    }
}

template <typename Variant> Decoded<Variant> decode(std::string_view text, std::size_t longest)
{
    const Decoded<Json> parsed = parse_object(text, longest);
    if (const auto* error = std::get_if<DecodeError>(&parsed))
        return *error;
    const Json& json = *std::get_if<Json>(&parsed);
    const auto type = json.find("type");
    if (type == json.end())
        return DecodeError{ErrorCode::kMissingField, "type", "is missing"};
    if (!type->is_string())
        return DecodeError{ErrorCode::kWrongType, "type", "has the wrong type, expected a string"};
    return read_as<Variant>(type->get_ref<const std::string&>(), json);
}

// ---------------------------------------------------------------- encoding

template <typename T> Json to_json_value(const std::vector<T>& values);
template <typename T> Json to_json_value(const std::map<std::string, T>& values);

template <typename T> Json to_json_value(const T& value)
{
    if constexpr (Fielded<T>) {
        Json json = Json::object();
        T::each_field(value, [&](std::string_view name, const auto& member, const Rule&) {
            if constexpr (IsOptional<std::remove_cvref_t<decltype(member)>>::value) {
                if (member)
                    json[std::string(name)] = to_json_value(*member);
            } else {
                json[std::string(name)] = to_json_value(member);
            }
        });
        return json;
    } else if constexpr (std::is_enum_v<T>) {
        return name_of(value);
    } else {
        return value;
    }
}

template <typename T> Json to_json_value(const std::vector<T>& values)
{
    Json json = Json::array();
    for (const T& value : values)
        json.push_back(to_json_value(value));
    return json;
}

template <typename T> Json to_json_value(const std::map<std::string, T>& values)
{
    Json json = Json::object();
    for (const auto& [key, value] : values)
        json[key] = to_json_value(value);
    return json;
}

template <typename Variant> std::string encode_variant(const Variant& variant)
{
    return std::visit(
        [](const auto& message) {
            Json json = to_json_value(message);
            json["type"] = std::remove_cvref_t<decltype(message)>::kType;
            return json.dump(-1, ' ', false, Json::error_handler_t::replace);
        },
        variant);
}

}  // namespace

Decoded<ClientMessage> decode_client_message(std::string_view text)
{
    return decode<ClientMessage>(text, kMaxClientTextBytes);
}

Decoded<ServerMessage> decode_server_message(std::string_view text)
{
    return decode<ServerMessage>(text, kMaxServerTextBytes);
}

std::string encode(const ClientMessage& message)
{
    return encode_variant(message);
}
std::string encode(const ServerMessage& message)
{
    return encode_variant(message);
}

std::string to_string(const DecodeError& error)
{
    return (error.field.empty() ? "message" : error.field) + " " + error.problem;
}

Error to_error_message(const DecodeError& error)
{
    Error message{.code = error.code, .message = to_string(error)};
    if (!error.field.empty())
        message.field = error.field;
    return message;
}

}  // namespace farlight::protocol
