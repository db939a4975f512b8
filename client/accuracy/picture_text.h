// Pictures as text that a page can hold.
#pragma once

#include "client/metrics/metrics.h"

namespace farlight::client {

/// "data:image/png;base64,..." of sRGB bytes, three a pixel.
std::string png_data_uri(const std::vector<std::uint8_t>& rgb, ImageSize size);

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace farlight::client
