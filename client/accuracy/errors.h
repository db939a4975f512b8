// The error of each point of a sweep: the same frame with many seeds, against the reference.
#pragma once

#include "client/accuracy/grid.h"
#include "client/accuracy/reference.h"
#include "client/metrics/bootstrap.h"

#include <filesystem>

namespace farlight::client {

struct ErrorPlan {
    int seeds = 10;  ///< At least 3; of frames 1 to `seeds`.
    int history = 32;  ///< Frames before the measured one, where a denoiser remembers any.
    int flip_seeds = 3;  ///< FLIP is taken of so many of them: it takes longer than a frame.
    Settings settings;  ///< Of every point, as of the reference.
};

/// The point's last frame with each seed.
std::vector<std::vector<float>> draw_seeds(
    Rig& rig, const SweepPoint& point, const ErrorPlan& plan);
/// What draw_seeds() is going to take, for the progress bar.
double work_of_seeds(const SweepPoint& point, const ErrorPlan& plan);

/// The error of pictures that differ by their seed alone, as REPORT.md describes it.
nlohmann::json measured_error(const std::vector<std::vector<float>>& pictures,
    const ReferencePicture& reference, int flip_seeds);

/// Error of the averaging denoiser after each number of frames in `after` (ascending), 1 sample a
/// frame: by number of frames, as measured_error() gives it. The pictures, which are many, lie in
/// `folder` meanwhile, where those of an interrupted run are found again; it is gone afterwards.
std::map<int, nlohmann::json> averaging_errors(Rig& rig, const ErrorPlan& plan,
    const ReferencePicture& reference, const std::vector<int>& after,
    const std::filesystem::path& folder);
/// Removes what an interrupted averaging_errors() left in `folder`, and nothing else.
void remove_averaged(const std::filesystem::path& folder);
double work_of_averaging(const ErrorPlan& plan, const std::vector<int>& after);

/// {"value", "lower", "upper"}
nlohmann::json json_of(const Estimate& estimate);

}  // namespace farlight::client
