// JsonInput: a place in a JSON file a person wrote, and errors that name it.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace farlight::client {

/// A file that cannot be used. what() reads `FILE: /json/pointer: found X, expected Y`.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Every function throws InputError when the file says something else than asked for.
class JsonInput {
public:
    /// The whole file; not JSON is an error that names line and column.
    static JsonInput read(const std::filesystem::path& file);

    JsonInput(nlohmann::json value, std::string file, std::string pointer = "")
        : value_(std::move(value))
        , file_(std::move(file))
        , pointer_(std::move(pointer))
    {
    }

    const nlohmann::json& value() const { return value_; }
    const std::string& file() const { return file_; }

    /// An object whose members are all among `keys`.
    void expect_object(std::initializer_list<std::string_view> keys) const;
    bool has(const std::string& key) const { return value_.is_object() && value_.contains(key); }
    /// The member `key`, which must be there.
    JsonInput at(const std::string& key) const;
    std::optional<JsonInput> find(const std::string& key) const;
    std::vector<JsonInput> elements() const;  ///< Of an array.
    std::vector<std::pair<std::string, JsonInput>> members() const;  ///< Of an object.

    double number(double lower, double upper) const;
    int integer(int lower, int upper) const;
    bool boolean() const;
    std::string string() const;

    [[noreturn]] void fail(const std::string& expected) const;
    /// The same with the finding in other words than the JSON itself.
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const;

private:
    nlohmann::json value_;
    std::string file_;
    std::string pointer_;
};

}  // namespace farlight::client
