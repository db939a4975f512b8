// Picture: the pixels of one frame on the client, and how a frame's payload becomes one.
#pragma once

#include "protocol/frame_header.h"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace farlight::client {

/// A frame payload or picture file that is not what it says it is.
struct PictureError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// RGB, rows packed, row 0 on top. Exactly one of the two arrays is filled, with width * height * 3
/// values.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<float> linear;  ///< Linear radiance before exposure and tone mapping.
    std::vector<std::uint8_t> display;  ///< sRGB as shown.
};

/// Decodes JPEG, PNG or raw. Throws PictureError when the payload is broken or its size differs
/// from the header's.
Picture decode_picture(const protocol::FrameHeader& header, std::span<const std::byte> payload);

/// XXH64, seed 0: what FrameHeader::framebuffer_hash is of a lossless frame's pixels.
std::uint64_t hash_pixels(const Picture& picture);
std::uint64_t hash_bytes(std::span<const std::byte> bytes);

}  // namespace farlight::client
