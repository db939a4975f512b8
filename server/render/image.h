// Image: pixels on the CPU, as they come back from the GPU. Row 0 is the top of the picture.
#pragma once

#include "server/gl/extent.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace farlight {

enum class PixelFormat : std::uint8_t {
    kRgb8,  ///< Tone-mapped sRGB, 3 bytes a pixel, rows packed.
    kRgb32f,  ///< Linear radiance before exposure, 3 floats a pixel, rows packed.
};

constexpr std::size_t bytes_per_pixel(PixelFormat format)
{
    return format == PixelFormat::kRgb8 ? 3 : 12;
}

struct Image {
    Extent extent;
    PixelFormat format = PixelFormat::kRgb8;
    std::vector<std::byte> bytes;  ///< width * height * bytes_per_pixel(format).
    Extent full_extent;  ///< It is to be shown at.
};

}  // namespace farlight
