// Pairing files by name, and telling what was found.
#include "client/cli/compared_files.h"

#include "client/json_input.h"
#include "client/picture_file.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace farlight::client {
namespace {

using Path = std::filesystem::path;

constexpr std::string_view kPictureExtensions[] = {".png", ".jpg", ".pfm", ".exr"};

std::set<std::string> pictures_in(const Path& folder)
{
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (std::find(std::begin(kPictureExtensions), std::end(kPictureExtensions), extension)
            != std::end(kPictureExtensions))
            names.insert(entry.path().filename().string());
    }
    if (names.empty())
        throw InputError(folder.string() + ": found no pictures, expected .png, .pfm or .exr");
    return names;
}

/// "a, b" of the first few names that `others` lacks.
std::string missing_in(const std::set<std::string>& names, const std::set<std::string>& others)
{
    constexpr int kNamed = 5;
    std::string text;
    int count = 0;
    for (const std::string& name : names)
        if (!others.contains(name) && ++count <= kNamed)
            text += (text.empty() ? "" : ", ") + name;
    return count > kNamed ? text + " and " + std::to_string(count - kNamed) + " more" : text;
}

std::string padded(std::string text, std::size_t width)
{
    text.resize(std::max(text.size(), width), ' ');
    return text;
}

std::string aligned_right(const std::string& text, std::size_t width)
{
    return std::string(width - std::min(text.size(), width), ' ') + text;
}

std::string formula_lines(const std::vector<MetricValue>& values)
{
    std::string text;
    for (const MetricValue& value : values) {
        const Metric& metric = *find_metric(value.name);
        const std::string unit = metric.unit.empty() ? "" : " " + std::string(metric.unit);
        text += padded(std::string(metric.name), 11) + padded(number_text(value.value) + unit, 14)
            + std::string(metric.formula) + "\n";
    }
    return text;
}

std::string pooled_line(const char* name, const Pooled& pooled)
{
    return padded(name, 11) + "weighted median " + number_text(pooled.weighted_median)
        + ", quartiles " + number_text(pooled.first_quartile) + " and "
        + number_text(pooled.third_quartile) + ", from " + number_text(pooled.lowest) + " to "
        + number_text(pooled.highest) + "\n";
}

/// One row a file.
std::string file_table(const CompareReport& report)
{
    constexpr std::size_t kColumn = 12;
    std::size_t widest = 4;
    for (const ComparedFile& file : report.files)
        widest = std::max(widest, file.files.test.filename().string().size());
    std::string text = padded("file", widest);
    for (const MetricValue& value : report.files.front().comparison.values)
        text += aligned_right(std::string(value.name), kColumn);
    for (const ComparedFile& file : report.files) {
        text += "\n" + padded(file.files.test.filename().string(), widest);
        for (const MetricValue& value : file.comparison.values)
            text += aligned_right(number_text(value.value), kColumn);
    }
    return text + "\n\n";
}

nlohmann::json to_json(const Pooled& pooled)
{
    return {{"mean", pooled.mean}, {"weighted_median", pooled.weighted_median},
        {"first_quartile", pooled.first_quartile}, {"third_quartile", pooled.third_quartile},
        {"lowest", pooled.lowest}, {"highest", pooled.highest}};
}

nlohmann::json to_json(const std::vector<MetricValue>& values)
{
    nlohmann::json json = nlohmann::json::object();
    for (const MetricValue& value : values)
        json[std::string(value.name)] = value.value;
    return json;
}

nlohmann::json to_json(const ComparedFile& file)
{
    nlohmann::json json{{"test", file.files.test.string()},
        {"reference", file.files.reference.string()}, {"size", {file.size.width, file.size.height}},
        {"values", to_json(file.comparison.values)}, {"flip", to_json(file.comparison.flip)}};
    if (file.comparison.hdr_flip)
        json["hdr_flip"] = to_json(*file.comparison.hdr_flip);
    return json;
}

}  // namespace

std::string number_text(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::vector<FilePair> paired(const Path& test, const Path& reference)
{
    const bool folder = std::filesystem::is_directory(test);
    if (folder != std::filesystem::is_directory(reference))
        throw InputError("found a folder and a file, expected two folders or two files: "
            + test.string() + ", " + reference.string());
    if (!folder)
        return {{test, reference}};
    const std::set<std::string> names = pictures_in(test);
    const std::set<std::string> others = pictures_in(reference);
    if (const std::string lacks = missing_in(names, others); !lacks.empty())
        throw InputError(reference.string() + ": lacks " + lacks);
    if (const std::string lacks = missing_in(others, names); !lacks.empty())
        throw InputError(test.string() + ": lacks " + lacks);
    std::vector<FilePair> pairs;
    pairs.reserve(names.size());
    for (const std::string& name : names)
        pairs.push_back({test / name, reference / name});
    return pairs;
}

Appearance read_appearance(const Path& file, const DisplayOptions& options)
{
    try {
        return appearance_of(read_picture(file), options);
    } catch (const PictureError& problem) {
        throw InputError(problem.what());
    }
}

std::vector<std::uint8_t> read_mask(const Path& file)
{
    const Appearance picture = read_appearance(file, {});
    std::vector<std::uint8_t> mask(picture.size.pixels());
    for (std::size_t i = 0; i < mask.size(); ++i)
        for (std::size_t channel = 3 * i; channel < 3 * i + 3; ++channel)
            mask[i] |= picture.linear[channel] > 0 ? 1 : 0;
    return mask;
}

std::vector<MetricValue> mean_over_files(const CompareReport& report)
{
    std::vector<MetricValue> means = report.files.front().comparison.values;
    for (std::size_t i = 0; i < means.size(); ++i) {
        means[i].value = 0;
        for (const ComparedFile& file : report.files)
            means[i].value +=
                file.comparison.values[i].value / static_cast<double>(report.files.size());
    }
    return means;
}

std::string text_of(const CompareReport& report)
{
    const ComparedFile& first = report.files.front();
    std::string text = std::to_string(first.size.width) + "x" + std::to_string(first.size.height)
        + (first.is_light ? ", x and r linear radiance, X and R as displayed"
                          : ", display values; x and r are decoded from sRGB, tone curve included")
        + ", FLIP at " + number_text(report.pixels_per_degree) + " px a degree\n";
    if (report.files.size() > 1)
        text +=
            file_table(report) + "mean over " + std::to_string(report.files.size()) + " files\n";
    text += formula_lines(mean_over_files(report));
    if (report.files.size() == 1) {
        text += pooled_line("flip", first.comparison.flip);
        if (first.comparison.hdr_flip)
            text += pooled_line("hdr_flip", *first.comparison.hdr_flip);
    }
    if (report.sequence)
        text += "the " + std::to_string(report.sequence->frames) + " files as a sequence\n"
            + formula_lines(report.sequence->values);
    return text;
}

nlohmann::json json_of(const CompareReport& report)
{
    nlohmann::json json{{"kind", report.files.front().is_light ? "linear" : "display"},
        {"pixels_per_degree", report.pixels_per_degree}, {"metrics", nlohmann::json::array()},
        {"files", nlohmann::json::array()}, {"mean", to_json(mean_over_files(report))},
        {"sequence", nullptr}};
    for (const Metric& metric : kMetrics)
        json["metrics"].push_back({{"name", metric.name}, {"formula", metric.formula},
            {"meaning", metric.meaning}, {"unit", metric.unit},
            {"better", metric.better == Better::kLower ? "lower" : "higher"}});
    for (const ComparedFile& file : report.files)
        json["files"].push_back(to_json(file));
    if (report.sequence)
        json["sequence"] = {
            {"frames", report.sequence->frames}, {"values", to_json(report.sequence->values)}};
    return json;
}

}  // namespace farlight::client
