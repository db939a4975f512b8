// Numbers as colours, and pictures as text that a page can hold.
#pragma once

#include "client/metrics/metrics.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

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

/// The mean of each pixel's three values.
std::vector<float> channel_means(std::span<const float> rgb);

/// The value that `share` of the values do not exceed; `values` not empty.
double quantile_of(std::vector<float> values, double share);

/// "data:image/png;base64,..." of sRGB bytes, three a pixel.
std::string png_data_uri(const std::vector<std::uint8_t>& rgb, ImageSize size);

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace farlight::client
