// Numbers as colours: palettes, scales, and pictures of where a picture differs from its reference.
#pragma once

#include "client/metrics/metrics.h"
#include "client/picture.h"

namespace farlight::client {

/// Colours for a share in [0, 1]; what lies outside takes the nearest end, NaN the lower one.
enum class Palette : std::uint8_t {
    kMagma,  ///< Dark to light, even to the eye and in grey (van der Walt, Smith 2015).
    kViridis,  ///< Likewise.
    kDiverging,  ///< Blue, white, vermilion: Okabe and Ito 2008, told apart by everybody.
};

/// sRGB bytes, three a value.
std::vector<std::uint8_t> colored(std::span<const float> shares, Palette palette);

/// log10(value) from `lower` to `upper`, both above 0, to [0, 1].
std::vector<float> log_shares(std::span<const float> values, double lower, double upper);
/// -bound to bound, to [0, 1].
std::vector<float> signed_shares(std::span<const float> values, double bound);

/// |x - r| of each pixel, the mean over its channels.
std::vector<float> absolute_differences(
    std::span<const float> test, std::span<const float> reference);
/// (x - r) / (|r| + 0.01) of each pixel's luminance.
std::vector<float> relative_differences(
    std::span<const float> test, std::span<const float> reference);

/// The absolute error that is black, and the one that is brightest; between them logarithmic.
constexpr double kLeastShownError = 1e-3;
constexpr double kMostShownError = 10;

/// One value in [0, 1] a pixel, as FLIP's.
Picture heat_map(std::span<const float> values, ImageSize size);
/// absolute_differences(), logarithmic.
Picture absolute_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size);
/// relative_differences(): vermilion is too bright, blue too dark, saturated at a factor of 2.
Picture signed_heat_map(
    std::span<const float> test, std::span<const float> reference, ImageSize size);

}  // namespace farlight::client
