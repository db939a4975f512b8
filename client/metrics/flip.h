// FLIP: the difference a person sees who alternates two pictures on a screen.
// Sources: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020, "FLIP: A
// Difference Evaluator for Alternating Images"; Andersson, Nilsson, Shirley, Akenine-Moeller 2021,
// "Visualizing Errors in Rendered High Dynamic Range Images"; the same 2021, "Visualizing and
// Communicating Errors in Rendered Images", Ray Tracing Gems II, chapter 19 (pooling).
#pragma once

#include "client/metrics/metrics.h"

#include <optional>

namespace farlight::client {

/// A screen of 3840 pixels on 0.7 m, seen from 0.7 m: 67.02 pixels a degree.
constexpr double kPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

/// Stops that HDR-FLIP looks at the pictures with: exposure 2^stop, evenly from start to stop.
struct FlipExposures {
    double start = 0;
    double stop = 0;
    int count = 2;
};

/// From the reference alone: its brightest pixel and its median just below white. Departure: where
/// the median is black, that of the pixels that are not black stands in for it.
FlipExposures flip_exposures(std::span<const float> reference_linear);

/// Error in [0, 1] of each pixel, rows packed. Display values in [0, 1], as ldr_flip() takes them,
/// are sRGB; linear ones, as hdr_flip() takes them, lie before exposure and tone curve, and what is
/// below 0 counts as 0. Both throw MetricError as expect_comparable() does, and when the number of
/// values is not that of `size`.
std::vector<float> ldr_flip(std::span<const float> test_display,
    std::span<const float> reference_display, ImageSize size,
    double pixels_per_degree = kPixelsPerDegree);
std::vector<float> hdr_flip(std::span<const float> test_linear,
    std::span<const float> reference_linear, ImageSize size,
    double pixels_per_degree = kPixelsPerDegree,
    const std::optional<FlipExposures>& exposures = {});

/// What one number, or six, tell of an error map.
struct Pooled {
    double mean = 0;
    double weighted_median = 0;  ///< Errors up to it make up half of the sum of all.
    double first_quartile = 0;  ///< Weighted likewise.
    double third_quartile = 0;
    double lowest = 0;
    double highest = 0;
};
/// Of the pixels that count. A pixel sees neighbours that do not.
Pooled pool(std::span<const float> errors, Mask mask = {});

}  // namespace farlight::client
