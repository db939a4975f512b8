// Which settings a sweep measures: one point each, made from what the server says it can be set to.
#pragma once

#include "client/script/script.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace farlight::client {

/// Drawn by averaging frames: the reference, and not a way to draw one frame.
constexpr const char* kAveraging = "accumulate";
/// Drawn by leaving the samples as they are.
constexpr const char* kRaw = "none";

/// Classic: raw samples against one filtered sample, and nothing else.
enum class GridSize : std::uint8_t { kTiny, kClassic, kQuick, kNormal };

struct SweepPoint {
    std::string label;  ///< "svgf, 2 samples, resolution 0.5"
    Settings settings;  ///< Every swept setting that the server has, by key.

    std::string id() const { return nlohmann::json(settings).dump(); }
    std::string text(const std::string& key) const;  ///< "" where the server has no such setting.
    int samples() const { return settings.at("samples_per_pixel").get<int>(); }
    std::string denoiser() const { return text("denoiser"); }
};

struct Grid {
    /// The values that the sweep starts from: the server's, a denoiser that filters, one sample.
    Settings base;
    std::vector<SweepPoint> points;  ///< No two alike.
};

/// `described`: the setting descriptions of a welcome message.
/// Throws std::invalid_argument when it lacks denoiser, samples_per_pixel or max_depth.
Grid make_grid(const nlohmann::json& described, GridSize size);

/// "denoiser none → svgf, samples 1 → 4": what turns one point into the other; "" for the same.
/// What only filters know is told of no raw point.
std::string changes_between(const Settings& from, const Settings& to);

/// "samples" for samples_per_pixel: a setting's word in labels.
std::string word_for(const std::string& key);

/// How many frames of 1 sample the averaging denoiser is looked at after.
std::vector<int> averaged_frames(GridSize size);

}  // namespace farlight::client
