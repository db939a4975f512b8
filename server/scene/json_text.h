// Text -> JSON, strictly: syntax errors, numbers too large for a double, doubled keys and endless
// nesting are SceneErrors with line, column and JSON pointer.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace farlight {

/// The whole file. Throws SceneError if it is missing, a folder, unreadable or empty; `expected` is
/// what should have been in it.
std::string read_file(const std::filesystem::path& file, std::string_view expected = "a scene");

/// `name` stands for the file in errors.
nlohmann::json parse_json(std::string_view text, const std::string& name);

}  // namespace farlight
