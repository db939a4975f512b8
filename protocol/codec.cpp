// JSON text <-> messages, driven by each message's each_field list.
#include "protocol/codec.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace farlight::protocol {
namespace {

using Json = nlohmann::json;

template <typename T> struct IsOptional : std::false_type {
};
template <typename T> struct IsOptional<std::optional<T>> : std::true_type {
};

template <typename T>
concept Fielded = requires(T value)
{
    T::each_field(value, [](auto&&...) {});
};

std::string number_text(double value)
{
    return Json(value).dump();
}

/// Fills messages from JSON; keeps the first problem it meets and then reads no further.
class Reader {
public:
    void read(const Json& json,
        auto& message) requires Fielded<std::remove_reference_t<decltype(message)>>
    {
        using Message = std::remove_reference_t<decltype(message)>;
        if (!json.is_object())
            return fail(ErrorCode::kWrongType, "has the wrong type, expected an object");
        Message::each_field(message, [&](std::string_view name, auto& member, const Rule& rule) {
            read_field(json, name, member, rule);
        });
    }

    const std::optional<DecodeError>& error() const { return error_; }

    void fail(ErrorCode code, std::string problem)
    {
        if (!error_)
            error_ = DecodeError{code, path_, std::move(problem)};
    }

    void fail_at(std::string_view field, ErrorCode code, std::string problem)
    {
        const Scope scope(*this, field);
        fail(code, std::move(problem));
    }

private:
    /// Lengthens the path while one field is read.
    class Scope {
    public:
        Scope(Reader& reader, std::string_view name) : reader_(reader), length_(reader.path_.size())
        {
            if (length_ != 0)
                reader_.path_ += '.';
            reader_.path_ += name;
        }
        ~Scope() { reader_.path_.resize(length_); }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Reader& reader_;
        std::size_t length_;
    };

    template <typename T>
    void read_field(const Json& json, std::string_view name, T& member, const Rule& rule)
    {
        if (error_)
            return;
        const Scope scope(*this, name);
        const auto found = json.find(name);
        if (found == json.end()) {
            if (rule.required && !IsOptional<T>::value)
                fail(ErrorCode::kMissingField, "is missing");
            return;
        }
        value(*found, member, rule);
    }

    void wrong_type(std::string_view expected)
    {
        fail(ErrorCode::kWrongType, "has the wrong type, expected " + std::string(expected));
    }

    void out_of_range(const std::string& found, const Rule& rule)
    {
        fail(ErrorCode::kOutOfRange,
            "is " + found + ", expected " + number_text(rule.lower) + " to "
                + number_text(rule.upper));
    }

    void value(const Json& json, double& out, const Rule& rule)
    {
        if (!json.is_number())
            return wrong_type("a number");
        out = json.get<double>();
        if (!std::isfinite(out))
            return fail(ErrorCode::kNotFinite, "is not finite");
        if (out < rule.lower || out > rule.upper)
            out_of_range(json.dump(), rule);
    }

    template <typename T>
    requires std::is_same_v<T, std::uint32_t> || std::is_same_v<T, std::uint64_t>
    void value(const Json& json, T& out, Rule rule)
    {
        if (!json.is_number_integer())
            return wrong_type("a whole number");
        rule.lower = std::max(rule.lower, 0.0);
        rule.upper = std::min(rule.upper, static_cast<double>(std::numeric_limits<T>::max()));
        // Negative numbers are stored signed, all others unsigned.
        const bool fits = json.is_number_unsigned()
            && json.get<std::uint64_t>() <= std::numeric_limits<T>::max()
            && json.get<double>() >= rule.lower && json.get<double>() <= rule.upper;
        if (!fits)
            return out_of_range(json.dump(), rule);
        out = json.get<T>();
    }

    void value(const Json& json, bool& out, const Rule&)
    {
        if (!json.is_boolean())
            return wrong_type("true or false");
        out = json.get<bool>();
    }

    void value(const Json& json, std::string& out, const Rule& rule)
    {
        if (!json.is_string())
            return wrong_type("a string");
        out = json.get<std::string>();
        if (out.size() > rule.longest)
            fail(ErrorCode::kTooLarge,
                "has " + std::to_string(out.size()) + " bytes, expected at most "
                    + std::to_string(rule.longest));
    }

    template <typename T>
    requires std::is_enum_v<T>
    void value(const Json& json, T& out, const Rule&)
    {
        std::string known;
        for (const std::string_view name : names_of(T{}))
            known += (known.empty() ? "" : ", ") + std::string(name);
        if (!json.is_string())
            return wrong_type("one of " + known);
        const auto& word = json.get_ref<const std::string&>();
        if (const auto found = from_name<T>(word))
            out = *found;
        else
            fail(ErrorCode::kOutOfRange,
                "is '" + word.substr(0, 64) + "', expected one of " + known);
    }

    /// A setting's value: which ones a setting takes, its list says.
    void value(const Json& json, Json& out, const Rule&)
    {
        if (json.is_null())
            return wrong_type("a value");
        out = json;
    }

    template <typename T> void value(const Json& json, std::optional<T>& out, const Rule& rule)
    {
        value(json, out.emplace(), rule);
    }

    template <typename T, std::size_t kCount>
    void value(const Json& json, std::array<T, kCount>& out, const Rule& rule)
    {
        if (!json.is_array() || json.size() != kCount)
            return wrong_type("an array of " + std::to_string(kCount) + " numbers");
        for (std::size_t i = 0; i < kCount && !error_; ++i) {
            const Scope scope(*this, std::to_string(i));
            value(json[i], out[i], rule);
        }
    }

    template <typename T> void value(const Json& json, std::vector<T>& out, const Rule& rule)
    {
        if (!json.is_array())
            return wrong_type("an array");
        out.clear();
        for (std::size_t i = 0; i < json.size() && !error_; ++i) {
            const Scope scope(*this, std::to_string(i));
            value(json[i], out.emplace_back(), rule);
        }
    }

    template <typename T>
    void value(const Json& json, std::map<std::string, T>& out, const Rule& rule)
    {
        if (!json.is_object())
            return wrong_type("an object");
        out.clear();
        for (const auto& [key, element] : json.items()) {
            if (error_)
                return;
            const Scope scope(*this, key.substr(0, 64));
            value(element, out[key], rule);
        }
    }

    void value(const Json& json, auto& out,
        const Rule&) requires Fielded<std::remove_reference_t<decltype(out)>>
    {
        read(json, out);
    }

    std::string path_;
    std::optional<DecodeError> error_;
};

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
void check(const Pose& pose, Reader& reader)
{
    if (pose.position == pose.target)
        reader.fail_at("target", ErrorCode::kOutOfRange, "equals position, expected another point");
    if (pose.up == std::array<double, 3>{0, 0, 0})
        reader.fail_at("up", ErrorCode::kOutOfRange, "is zero, expected a direction");
}
void check(const Camera& camera, Reader& reader)
{
    check(camera.pose, reader);
}
void check(const Set& set, Reader& reader)
{
    if (set.value.is_structured())
        reader.fail_at("value", ErrorCode::kWrongType,
            "has the wrong type, expected a string, number or boolean");
}
void check(const auto&, Reader&) { }

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
        Reader reader;
        reader.read(json, message);
        if (!reader.error())
            check(message, reader);
        if (reader.error())
            return *reader.error();
        return Variant(std::move(message));
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
