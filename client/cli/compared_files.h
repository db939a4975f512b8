// The files of `farlight compare`: which belong together, what was found of each, and how it is
// told.
#pragma once

#include "client/metrics/compare.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace farlight::client {

struct FilePair {
    std::filesystem::path test;
    std::filesystem::path reference;
};

/// Two files, or the pictures of two folders by name, in the order of their names. Throws
/// InputError for a file without partner, a folder without pictures, a file beside a folder.
std::vector<FilePair> paired(
    const std::filesystem::path& test, const std::filesystem::path& reference);

/// Reads a picture for comparison. Throws InputError naming the file.
Appearance read_appearance(const std::filesystem::path& file, const DisplayOptions& options);

/// The pixels that are above 0 in any channel. Throws InputError naming the file.
std::vector<std::uint8_t> read_mask(const std::filesystem::path& file);

struct ComparedFile {
    FilePair files;
    ImageSize size;
    bool is_light = false;
    PictureComparison comparison;
};

/// Of all frames of the test, in the order of their names.
struct ComparedSequence {
    int frames = 0;
    std::vector<MetricValue> values;  ///< flicker and difference.
};

struct CompareReport {
    double pixels_per_degree = kPixelsPerDegree;
    std::vector<ComparedFile> files;  ///< At least one.
    std::optional<ComparedSequence> sequence;  ///< Of two frames or more.
};

/// Each metric's mean over the files, by the order of the table.
std::vector<MetricValue> mean_over_files(const CompareReport& report);

/// Four significant digits, as all figures of comparisons are printed.
std::string number_text(double value);
/// For people; every number with its formula.
std::string text_of(const CompareReport& report);
nlohmann::json json_of(const CompareReport& report);

}  // namespace farlight::client
