// Text and JSON in and out of RenderSettings. One visitor a direction; the list itself is in
// settings.h.
#include "server/render/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <type_traits>

namespace farlight {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(std::string_view key, const json& found, const std::string& expected)
{
    const std::string text = found.dump(-1, ' ', false, json::error_handler_t::replace);
    throw SettingError(
        "setting '" + std::string(key) + "': found " + text + ", expected " + expected);
}

std::string join(std::span<const std::string_view> words)
{
    std::string text;
    for (const std::string_view word : words)
        text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

std::string shown(double value)
{
    return json(value).dump();
}

/// The number in `value`, whether written as a number, a boolean or a string holding one; NaN if it
/// is none.
double number_in(const json& value)
{
    if (value.is_boolean())
        return value.get<bool>() ? 1 : 0;
    if (value.is_number())
        return value.get<double>();
    if (value.is_string()) {
        const auto& text = value.get_ref<const std::string&>();
        double number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && end == text.data() + text.size())
            return number;
        if (text == "true" || text == "false")
            return text == "true" ? 1 : 0;
    }
    return std::nan("");
}

template <typename T, std::size_t N>
void assign(T& member, std::string_view key, const std::string_view (&names)[N], const json& value)
{
    static_assert(std::is_enum_v<T>);
    if (value.is_string()) {
        const auto* const found =
            std::find(std::begin(names), std::end(names), value.get<std::string>());
        if (found != std::end(names)) {
            member = static_cast<T>(found - std::begin(names));
            return;
        }
    }
    refuse(key, value, "one of " + join(names));
}

template <typename T>
void assign(T& member, std::string_view key, IntRange range, const json& value)
{
    const double number = number_in(value);
    if (!(number >= static_cast<double>(range.lower) && number <= static_cast<double>(range.upper)
            && number == std::floor(number)))
        refuse(key, value,
            "a whole number from " + std::to_string(range.lower) + " to "
                + std::to_string(range.upper));
    if constexpr (std::is_same_v<T, bool>)
        member = number != 0;
    else
        member = static_cast<T>(number);
}

void assign(float& member, std::string_view key, RealRange range, const json& value)
{
    const double number = number_in(value);
    if (!(number >= range.lower && number <= range.upper))
        refuse(key, value, "a number from " + shown(range.lower) + " to " + shown(range.upper));
    member = static_cast<float>(number);
}

void assign(EffectChoice& member, std::string_view key, TextRule /*rule*/, const json& value)
{
    std::string problem;
    if (value.is_string()) {
        try {
            member = parse_effect_choice(value.get_ref<const std::string&>());
            return;
        } catch (const std::invalid_argument& reason) {
            problem = std::string(" (") + reason.what() + ")";
        }
    }
    std::string names;
    for (const std::string_view name : EffectMask::general().names())
        names.append(", ").append(name);
    refuse(key, value, "auto, general, or a list with commas of" + names.substr(1) + problem);
}

/// The shortest decimal that reads back as the same float: 0.2, not 0.20000000298.
double decimal(float value)
{
    char text[32];
    const auto end = std::to_chars(std::begin(text), std::end(text), value).ptr;
    double number = 0;
    std::from_chars(std::begin(text), end, number);
    return number;
}

template <typename T, std::size_t N> json row_of(T value, const std::string_view (&names)[N])
{
    return {
        {"type", "choice"}, {"value", names[static_cast<std::size_t>(value)]}, {"choices", names}};
}

template <typename T> json row_of(T value, IntRange range)
{
    return {{"type", std::is_same_v<T, bool> ? "boolean" : "integer"}, {"value", value},
        {"lower", range.lower}, {"upper", range.upper}};
}

json row_of(float value, RealRange range)
{
    return {{"type", "real"}, {"value", decimal(value)}, {"lower", range.lower},
        {"upper", range.upper}};
}

json row_of(const EffectChoice& value, TextRule /*rule*/)
{
    return {{"type", "text"}, {"value", to_text(value)}};
}

json rows_of(const RenderSettings& settings)
{
    json rows = json::array();
    RenderSettings::each_field(settings,
        [&](const auto& member, std::string_view name, const auto& allowed, std::string_view help) {
            json row = row_of(member, allowed);
            row["key"] = name;
            row["help"] = help;
            rows.push_back(std::move(row));
        });
    return rows;
}

}  // namespace

void set_setting(RenderSettings& settings, std::string_view key, const json& value)
{
    bool known = false;
    std::string names;
    RenderSettings::each_field(
        settings, [&](auto& member, std::string_view name, const auto& allowed, auto) {
            names += (names.empty() ? "" : ", ") + std::string(name);
            if (name == key) {
                known = true;
                assign(member, key, allowed, value);
            }
        });
    if (!known)
        throw SettingError(
            "setting '" + std::string(key) + "' is unknown, expected one of " + names);
}

void set_setting(RenderSettings& settings, std::string_view key_equals_value)
{
    const std::size_t equals = key_equals_value.find('=');
    if (equals == std::string_view::npos)
        throw SettingError("found '" + std::string(key_equals_value) + "', expected key=value");
    set_setting(
        settings, key_equals_value.substr(0, equals), json(key_equals_value.substr(equals + 1)));
}

json describe_settings(const RenderSettings& settings, const RenderSettings& defaults)
{
    json rows = rows_of(settings);
    const json default_rows = rows_of(defaults);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i]["default"] = default_rows[i]["value"];
    return rows;
}

}  // namespace farlight
