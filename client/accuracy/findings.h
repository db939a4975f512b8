// What a sweep's measurements say: frontier, prices, fits, crossings, what each technique brings.
// REPORT.md describes the JSON.
#pragma once

#include "client/accuracy/grid.h"

#include <map>

namespace farlight::client {

/// One point's figures: its error as measured_error() gives it, its times as summary_of() does.
struct MeasuredPoint {
    SweepPoint point;
    nlohmann::json error;
    nlohmann::json times;
};

struct Measurements {
    Settings base;
    std::vector<MeasuredPoint> points;
    std::map<int, nlohmann::json> averaging;  ///< Errors by number of frames of one sample.
    nlohmann::json averaging_times;  ///< Of one of these frames.
};

/// The parts "points", "frontier", "flip_frontier", "prices", "averaging", "fits", "slope",
/// "techniques", "classic" and "timing_check" of a report.
nlohmann::json findings_of(const Measurements& measured);

/// Frames whose passes' times differ from the whole frame's by more than this are marked ...
constexpr double kPassSumTolerance = 0.05;
/// ... and by more than this are wrong: timers or passes are missing.
constexpr double kPassSumFailure = 0.20;

}  // namespace farlight::client
