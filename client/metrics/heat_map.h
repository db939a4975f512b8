// Errors as colours: pictures of where a picture differs from its reference.
#pragma once

#include "client/metrics/metrics.h"
#include "client/picture.h"

namespace farlight::client {

/// sRGB in [0, 1].
struct Shade {
    double r = 0;
    double g = 0;
    double b = 0;
};

/// Black over purple and orange to pale yellow for x in [0, 1]; outside, the ends. Lightness rises
/// with x, for any colour vision and in print.
Shade magma(double x);
/// Blue for -1, white for 0, red for 1; beyond, the ends.
Shade blue_white_red(double x);

/// The absolute error that is black, and the one that is brightest; between them logarithmic.
constexpr double kLeastShownError = 1e-3;
constexpr double kMostShownError = 10;

/// One value in [0, 1] a pixel, as FLIP's.
Picture heat_map(std::span<const float> values, ImageSize size);
/// Mean |x - r| of the channels, logarithmic.
Picture absolute_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size);
/// (x - r) / (r + 0.01) of luminance: red is too bright, blue too dark, saturated at a factor of 2.
Picture signed_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size);

}  // namespace farlight::client
