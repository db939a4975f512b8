// The one wording of all errors in scene files.
#include "server/scene/scene_error.h"

#include <nlohmann/json.hpp>

namespace farlight {

namespace {

constexpr std::size_t kLongestQuote = 60;  // characters; keeps a message on one or two lines

std::string escaped(std::string_view key)
{
    std::string out;
    for (const char c : key) {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

std::string shortened(std::string text)
{
    if (text.size() <= kLongestQuote)
        return text;
    std::size_t end = kLongestQuote;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
        --end;  // never inside a UTF-8 sequence
    return text.substr(0, end) + "...";
}

}  // namespace

ScenePlace ScenePlace::operator/(std::string_view key) const
{
    return {file, pointer + '/' + escaped(key)};
}

ScenePlace ScenePlace::operator/(std::size_t index) const
{
    return {file, pointer + '/' + std::to_string(index)};
}

void refuse(const ScenePlace& place, std::string_view found, std::string_view expected)
{
    std::string message = place.file + ": ";
    if (!place.pointer.empty())
        message += place.pointer + ": ";
    message.append("found ").append(found).append(", expected ").append(expected);
    SceneError error(message);
    error.pointer = place.pointer;
    throw error;
}

std::string describe(const nlohmann::json& value)
{
    if (value.is_object())
        return value.empty() ? "an empty object" : "an object";
    if (value.is_array() && value.empty())
        return "an empty array";
    if (value.is_array() && value.size() > 16)  // longer arrays tell nothing on one line
        return "an array of " + std::to_string(value.size()) + " values";
    if (value.is_string())
        return in_quotes(value.get_ref<const std::string&>());
    return shortened(value.dump());
}

std::string in_quotes(std::string_view text)
{
    const nlohmann::json json(text);
    return shortened(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace farlight
