// The figures of quick and normal sweeps.
#include "client/accuracy/plans.h"

#include <algorithm>

namespace farlight::client {
namespace {

struct Effort {
    int history, flip_seeds, rounds, response_seeds, still_frames, after, effect_frames;
    int motion_frames;
    /// Samples of the reference over the most that a measured frame has: its own error is one over
    /// that of the smallest that raw samples have. With 128, filtered frames may be five times as
    /// good and have 5 times the reference's deviation, with 256 ten times.
    int reference_factor;
};

/// With svgf_alpha at 0.2, 12 frames leave 0.8^12 = 7 % of the first, 32 frames 0.1 %.
Effort effort_of(GridSize grid)
{
    switch (grid) {
    case GridSize::kTiny: return {4, 1, 2, 1, 8, 8, 2, 4, 128};
    case GridSize::kClassic: return {12, 2, 4, 2, 32, 24, 4, 6, 256};
    case GridSize::kQuick: return {12, 2, 4, 2, 32, 24, 4, 6, 128};
    case GridSize::kNormal: break;
    }
    return {32, 3, 16, 4, 64, 32, 12, 8, 256};
}

/// Settings of everything that is drawn: time stands still, pixels are looked at in their middles
/// as moving pictures are, and nobody but the sweep changes anything.
Settings fixed_settings(const Grid& grid)
{
    Settings settings = grid.base;
    settings["play"] = false;
    settings["antialiasing"] = false;
    settings["budget_ms"] = 0;
    settings["target_error"] = 0;
    settings["error_estimate"] = false;
    return settings;
}

int most_samples(const Grid& grid)
{
    int most = 1;
    for (const SweepPoint& point : grid.points)
        most = std::max(most, point.samples());
    return most;
}

}  // namespace

SweepPoint base_point(const Grid& grid)
{
    return {.label = "base", .settings = grid.base};
}

SweepPoint averaging_point(const Grid& grid)
{
    SweepPoint point{.label = "averaging", .settings = grid.base};
    point.settings["denoiser"] = kAveraging;
    return point;
}

SweepPoint raw_point(const Grid& grid)
{
    SweepPoint point{.label = "raw", .settings = grid.base};
    point.settings["denoiser"] = kRaw;
    return point;
}

Plans plans_for(const Grid& grid, const SweepExtent& extent)
{
    const Settings fixed = fixed_settings(grid);
    const Effort effort = effort_of(extent.grid);
    Plans plans;
    plans.reference = {.samples = extent.reference_samples > 0
            ? extent.reference_samples
            : effort.reference_factor * most_samples(grid),
        .batches = 16,
        .settings = fixed};
    plans.step_reference = plans.reference;
    plans.step_reference.samples = std::max(plans.reference.samples / 8, 16);
    plans.error = {.seeds = extent.seeds,
        .history = effort.history,
        .flip_seeds = effort.flip_seeds,
        .settings = fixed};
    plans.time = {.rounds = effort.rounds, .settling = 5, .frames = 4, .settings = fixed};
    plans.response = {.seeds = effort.response_seeds,
        .history = plans.error.history,
        .still_frames = effort.still_frames,
        .after = effort.after,
        .settings = fixed};
    plans.motion = plans.response;
    plans.motion.after = effort.after / 2;  // a picture follows a motion: it is never far behind
    plans.motion_frames = effort.motion_frames;
    plans.effects = {.frames = effort.effect_frames,
        .seeds = 4,
        .settings = fixed,
        .filtered = base_point(grid),
        .raw = raw_point(grid)};
    return plans;
}

std::vector<SweepPoint> response_points(const Grid& grid)
{
    std::vector<SweepPoint> points;
    const auto differs_in = [&](const SweepPoint& point, const std::string& key) {
        SweepPoint same = point;
        same.settings[key] = grid.base.at(key);
        return same.settings == grid.base && point.settings != grid.base;
    };
    for (const SweepPoint& point : grid.points)
        if (point.settings == grid.base || differs_in(point, "denoiser")
            || (grid.base.contains("history_max") && differs_in(point, "history_max"))
            || (point.samples() == 4 && differs_in(point, "samples_per_pixel")))
            points.push_back(point);
    return points;
}

}  // namespace farlight::client
