// Reading JSON that a person wrote.
#include "client/json_input.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace farlight::client {

using nlohmann::json;

JsonInput JsonInput::read(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream)
        throw InputError(file.string() + ": cannot be read");
    try {
        return {json::parse(text), file.string()};
    } catch (const json::parse_error& problem) {
        const auto end = text.begin()
            + static_cast<std::ptrdiff_t>(
                std::min(problem.byte == 0 ? 0 : problem.byte - 1, text.size()));
        const auto line = 1 + std::count(text.begin(), end, '\n');
        const auto line_start =
            std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
        throw InputError(file.string() + ":" + std::to_string(line) + ":"
            + std::to_string(1 + (end - line_start)) + ": is not JSON");
    } catch (const json::exception&) {
        throw InputError(file.string() + ": holds a number that is not finite");
    }
}

void JsonInput::fail(const std::string& expected) const
{
    constexpr std::size_t kLongest = 60;  // characters of the finding worth showing
    std::string found = value_.dump(-1, ' ', false, json::error_handler_t::replace);
    if (found.size() > kLongest)
        found = value_.is_array() ? "an array of " + std::to_string(value_.size())
                                  : std::string(value_.is_object() ? "an object" : "a long string");
    fail(found, expected);
}

void JsonInput::fail(const std::string& found, const std::string& expected) const
{
    throw InputError(file_ + ": " + (pointer_.empty() ? "/" : pointer_) + ": found " + found
        + ", expected " + expected);
}

void JsonInput::expect_object(std::initializer_list<std::string_view> keys) const
{
    if (!value_.is_object())
        fail("an object");
    for (const auto& [key, member] : value_.items()) {
        if (std::find(keys.begin(), keys.end(), key) != keys.end())
            continue;
        std::string known;
        for (const std::string_view name : keys)
            known += (known.empty() ? "" : ", ") + std::string(name);
        fail("unknown key '" + key + "'", "one of " + known);
    }
}

JsonInput JsonInput::at(const std::string& key) const
{
    if (auto found = find(key))
        return *found;
    fail("no key '" + key + "'", "it to be there");
}

std::optional<JsonInput> JsonInput::find(const std::string& key) const
{
    if (!has(key))
        return std::nullopt;
    return JsonInput(value_[key], file_, pointer_ + "/" + key);
}

std::vector<JsonInput> JsonInput::elements() const
{
    if (!value_.is_array())
        fail("an array");
    std::vector<JsonInput> found;
    for (std::size_t i = 0; i < value_.size(); ++i)
        found.emplace_back(value_[i], file_, pointer_ + "/" + std::to_string(i));
    return found;
}

std::vector<std::pair<std::string, JsonInput>> JsonInput::members() const
{
    if (!value_.is_object())
        fail("an object");
    std::vector<std::pair<std::string, JsonInput>> found;
    for (const auto& [key, member] : value_.items())
        found.emplace_back(key, JsonInput(member, file_, pointer_ + "/" + key));
    return found;
}

double JsonInput::number(double lower, double upper) const
{
    if (!value_.is_number() || !(value_.get<double>() >= lower && value_.get<double>() <= upper))
        fail("a number from " + json(lower).dump() + " to " + json(upper).dump());
    return value_.get<double>();
}

int JsonInput::integer(int lower, int upper) const
{
    const bool fits = value_.is_number_integer() && value_.get<double>() >= lower
        && value_.get<double>() <= upper;
    if (!fits)
        fail("a whole number from " + std::to_string(lower) + " to " + std::to_string(upper));
    return value_.get<int>();
}

bool JsonInput::boolean() const
{
    if (!value_.is_boolean())
        fail("true or false");
    return value_.get<bool>();
}

std::string JsonInput::string() const
{
    if (!value_.is_string())
        fail("a string");
    return value_.get<std::string>();
}

}  // namespace farlight::client
