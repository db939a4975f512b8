// From scene-linear radiance to display values as the server does it (shaders/lib/display.glsl),
// for metrics of what is seen. A test holds the two together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace farlight::client {

enum class ToneCurve : std::uint8_t { kAces, kLinear };

struct DisplayOptions {
    double exposure = 1;  ///< Linear scale before the curve, >= 0.
    ToneCurve curve = ToneCurve::kAces;
};

/// Source: Narkowicz 2016, "ACES Filmic Tone Mapping Curve". Any input lands in [0, 1].
double aces_curve(double x);
/// IEC 61966-2-1 (sRGB), for x in [0, 1].
double srgb_encode(double x);
double srgb_decode(double x);

/// Exposure, curve and sRGB: values in [0, 1].
std::vector<float> display_of_linear(
    std::span<const float> linear, const DisplayOptions& options = {});
/// 0..255 to [0, 1].
std::vector<float> display_of_bytes(std::span<const std::uint8_t> display);
/// sRGB bytes to linear values in [0, 1]; what exposure and curve did stays in them.
std::vector<float> linear_of_bytes(std::span<const std::uint8_t> display);

}  // namespace farlight::client
