// Encoder: a drawn frame to the bytes of its payload. Pure; runs on the encoding threads.
#pragma once

#include "protocol/frame_header.h"
#include "server/render/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace farlight {

/// A drawn frame and what is to become of it. `header` holds all but what encoding finds out.
struct EncodeTask {
    Image image;
    protocol::FrameHeader header;
    int jpeg_quality = 80;
};

/// A frame ready to be sent.
struct EncodedFrame {
    protocol::FrameHeader header;
    std::vector<std::uint8_t> payload;
    std::string error;  ///< Not empty: it could not be encoded and `payload` is empty.
};

/// Fills payload, payload_size, sizes, hash and encode_us. `header.format` decides the codec;
/// raw needs an image in PixelFormat::kRgb32f, the others one in kRgb8. Never throws.
EncodedFrame encode_frame(const EncodeTask& task);

/// The pixels the renderer must deliver for `format`.
PixelFormat pixel_format_for(protocol::Format format);

/// The payload decodes to exactly the pixels drawn.
bool is_lossless(protocol::Format format);

}  // namespace farlight
