// Image codecs: pixels to JPEG and PNG bytes.
#pragma once

#include "server/render/image.h"

#include <cstdint>
#include <vector>

namespace farlight {

enum class Chroma : std::uint8_t {
    k420,  ///< Half resolution both ways: small, blurs saturated edges at any quality.
    k444,  ///< Full resolution.
};

/// Appends `image` (8-bit RGB) as a JPEG to `bytes`; quality in [1, 100]. Thread-safe.
/// Throws std::runtime_error with libjpeg-turbo's reason.
void append_jpeg(std::vector<std::uint8_t>& bytes, const Image& image, int quality, Chroma chroma);

/// Appends `image` (8-bit RGB) as a PNG. Compresses lightly: a picture must be out in tens of
/// milliseconds. Thread-safe. Throws std::runtime_error when memory runs out.
void append_png(std::vector<std::uint8_t>& bytes, const Image& image);

}  // namespace farlight
