// Filling the page's template, and tables as text.
#include "client/accuracy/report_files.h"

#include "client/json_input.h"

#include <cstdio>
#include <fstream>
#include <set>

namespace farlight::client {
namespace {

using nlohmann::json;

/// In this order: a later one uses what an earlier one defines.
constexpr const char* kScripts[] = {"web/vendor/uplot/uPlot.iife.min.js",
    "accuracy/report/format.js", "accuracy/report/palette.js", "accuracy/report/dom.js",
    "accuracy/report/log_plot.js", "accuracy/report/error_time.js", "accuracy/report/tables.js",
    "accuracy/report/passes.js", "accuracy/report/response.js", "accuracy/report/gallery.js",
    "accuracy/report/main.js"};
constexpr const char* kStyles[] = {"web/vendor/uplot/uPlot.min.css", "accuracy/report/report.css"};
constexpr const char* kLicence = "web/vendor/uplot/LICENSE";

const std::string& part(const char* path)
{
    return report_files().at(path);
}

void replace_once(std::string& text, const std::string& mark, const std::string& by)
{
    const auto at = text.find(mark);
    if (at == std::string::npos)
        throw std::logic_error("the page has no " + mark);
    text.replace(at, mark.size(), by);
}

/// JSON that may stand in a script element: no "</script" and no "<!--" in it.
std::string for_script(const json& value)
{
    std::string text;
    for (const char c : value.dump(-1, ' ', false, json::error_handler_t::replace))
        text += c == '<' ? "\\u003c" : std::string(1, c);
    return text;
}

void write_text(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
        throw InputError(file.string() + ": cannot be written");
}

/// RFC 4180.
std::string csv_field(const json& value)
{
    if (!value.is_string())
        return value.is_null() ? "" : value.dump();
    std::string text = "\"";
    for (const char c : value.get<std::string>())
        text += c == '"' ? "\"\"" : std::string(1, c);
    return text + "\"";
}

std::string number(const char* format, const json& value)
{
    char text[48];
    std::snprintf(text, sizeof text, format, value.get<double>());
    return text;
}

}  // namespace

std::string page_of(const json& report)
{
    std::string styles;
    for (const char* path : kStyles)
        styles += part(path) + "\n";
    std::string scripts = "/*\n" + part(kLicence) + "\n*/\n";
    for (const char* path : kScripts)
        scripts += part(path) + "\n";
    std::string page = part("accuracy/report/page.html");
    replace_once(page, "/* STYLES */", styles);
    replace_once(page, "/* SCRIPTS */", scripts);
    replace_once(page, "\"REPORT\"", for_script(report));
    return page;
}

std::string csv_of(const json& report)
{
    const json& points = report.at("points");
    std::vector<std::string> columns{"label", "frontier", "ms", "ms_lower", "ms_upper", "whole_ms",
        "encode_ms", "relmse", "relmse_lower", "relmse_upper", "relmse999", "bias", "bias_lower",
        "bias_upper", "variance", "variance_lower", "variance_upper", "mse", "flip", "fireflies",
        "reference_limited"};
    std::string text;
    for (const std::string& column : columns)
        text += (text.empty() ? "" : ",") + column;
    const auto& settings = report.at("base");
    for (const auto& [key, value] : settings.items())
        text += "," + key;
    text += "\r\n";
    for (const json& point : points) {
        std::string line;
        for (const std::string& column : columns)
            line += (line.empty() ? "" : ",") + csv_field(point.value(column, json()));
        for (const auto& [key, value] : settings.items())
            line += "," + csv_field(point.at("settings").value(key, json()));
        text += line + "\r\n";
    }
    return text;
}

void write_report(const std::filesystem::path& folder, const json& report)
{
    json without_pictures = report;
    without_pictures.erase("gallery");
    write_text(folder / "accuracy.json",
        without_pictures.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
    write_text(folder / "accuracy.csv", csv_of(report));
    write_text(folder / "accuracy.html", page_of(report));
}

std::string summary_text(const json& report)
{
    std::string text = "| from here | ms | relMSE | to halve the error | by |\n"
                       "| --- | --- | --- | --- | --- |\n";
    for (const json& price : report.at("prices")) {
        text += "| " + price["label"].get<std::string>() + " | " + number("%.1f", price["ms"])
            + " | " + number("%.2g", price["relmse"]) + " | ";
        if (price.contains("extra_ms"))
            text += "+" + number("%.1f", price["extra_ms"]) + " ms | "
                + price["by"].get<std::string>() + " |\n";
        else
            text += "beyond this sweep | |\n";
    }
    text += "\n| frame | frames a second | relMSE | FLIP |\n| --- | --- | --- | --- |\n";
    for (const json& row : report.at("classic"))
        text += "| " + row["label"].get<std::string>() + " | "
            + number("%.1f", row["frames_per_second"]) + " | " + number("%.2g", row["relmse"])
            + " | " + number("%.3f", row["flip"]) + " |\n";
    return text;
}

}  // namespace farlight::client
