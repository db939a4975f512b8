// The report as files: one page that needs nothing else, a table and the whole as JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace farlight {

/// The page's parts, by path under client/; made by tools/embed.cmake.
const std::map<std::string, std::string, std::less<>>& report_files();

}  // namespace farlight

namespace farlight::client {

/// Writes accuracy.html, accuracy.csv and accuracy.json into the folder. Pictures ("gallery") are
/// in the page alone. Throws InputError.
void write_report(const std::filesystem::path& folder, const nlohmann::json& report);

/// The page around a report.
std::string page_of(const nlohmann::json& report);
/// A line a point, under a line of column names.
std::string csv_of(const nlohmann::json& report);

/// What the command prints when all is done: the price list and the classic comparison as Markdown
/// tables.
std::string summary_text(const nlohmann::json& report);

}  // namespace farlight::client
