// MessageReader: fills a message from JSON by its each_field list. Part of the codec.
#pragma once

#include "protocol/codec.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace farlight::protocol {

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

/// Whole numbers without a fraction, as the limits of integers are to be read.
inline std::string number_text(double value)
{
    constexpr double kExact = 1LL << 53;
    if (std::abs(value) <= kExact && std::trunc(value) == value)
        return std::to_string(static_cast<std::int64_t>(value));
    return Json(value).dump();
}

/// Fills messages from JSON; keeps the first problem it meets and then reads no further.
class MessageReader {
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
        Scope(MessageReader& reader, std::string_view name)
            : reader_(reader)
            , length_(reader.path_.size())
        {
            if (length_ != 0)
                reader_.path_ += '.';
            reader_.path_ += name;
        }
        ~Scope() { reader_.path_.resize(length_); }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        MessageReader& reader_;
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

}  // namespace farlight::protocol
