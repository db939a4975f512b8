// The binary head of a frame message: a fixed part, then a table of pass times, then the picture.
// PROTOCOL.md shows the byte table; a test holds the two together.
#pragma once

#include "protocol/codec.h"
#include "protocol/messages.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace farlight::protocol {

constexpr std::array<char, 4> kFrameMagic{'F', 'A', 'R', 'L'};
constexpr std::uint8_t kFrameVersion = 1;
constexpr std::uint16_t kFrameHeaderSize = 80;  ///< [bytes] of the fixed part this version writes.
constexpr std::size_t kMaxPasses = 256;
constexpr std::size_t kMaxPassNameBytes = 255;

/// Bits of FrameHeader::flags.
namespace frame_flags {
constexpr std::uint16_t kStill = 1U << 0U;  ///< The camera rests; the picture is being refined.
constexpr std::uint16_t kLossless = 1U
    << 1U;  ///< The payload decodes to exactly the pixels hashed.
constexpr std::uint16_t kHistoryReset = 1U << 2U;  ///< Drawn without history.
constexpr std::uint16_t kConverged = 1U
    << 3U;  ///< Final: no frame follows until something changes.
}  // namespace frame_flags

/// Milliseconds one pass took.
struct PassEntry {
    std::string name;
    float milliseconds = 0;

    bool operator==(const PassEntry&) const = default;
};

struct FrameHeader {
    Format format = Format::kJpeg420;
    std::uint16_t flags = 0;
    std::uint32_t frame_id = 0;  ///< Counts up by one a frame sent, from 1, per connection.
    std::uint32_t camera_sequence =
        0;  ///< Of the newest camera message in the picture; 0 before any.
    std::uint32_t session_epoch = 0;  ///< Counts up whenever size or scene change.
    std::uint32_t payload_size = 0;  ///< [bytes]
    std::uint16_t width = 0;  ///< [px] of the payload.
    std::uint16_t height = 0;
    std::uint16_t full_width = 0;  ///< [px] the payload is to be shown at.
    std::uint16_t full_height = 0;
    std::uint32_t accumulated_samples = 0;
    float predicted_error =
        std::numeric_limits<float>::quiet_NaN();  ///< relMSE; NaN: not estimated.
    std::uint32_t wait_us = 0;
    std::uint32_t trace_us = 0;
    std::uint32_t denoise_us = 0;
    std::uint32_t encode_us = 0;
    std::uint32_t nonfinite_count = 0;
    float scene_time = 0;  ///< [s] that the picture shows; 0 where nothing follows time.
    std::uint64_t framebuffer_hash = 0;  ///< XXH64, seed 0, of the unencoded pixel bytes.

    std::vector<PassEntry> passes;  ///< In execution order.

    bool has(std::uint16_t flag) const { return (flags & flag) != 0; }

    /// visit(offset [bytes], name, member) for the fields of the fixed part that a picture decides;
    /// magic, version, header_size, pass_count and passes_size follow from the rest.
    static void each_field(auto& h, auto&& visit)
    {
        visit(5, "format", h.format);
        visit(8, "flags", h.flags);
        visit(16, "frame_id", h.frame_id);
        visit(20, "camera_sequence", h.camera_sequence);
        visit(24, "session_epoch", h.session_epoch);
        visit(28, "payload_size", h.payload_size);
        visit(32, "width", h.width);
        visit(34, "height", h.height);
        visit(36, "full_width", h.full_width);
        visit(38, "full_height", h.full_height);
        visit(40, "accumulated_samples", h.accumulated_samples);
        visit(44, "predicted_error", h.predicted_error);
        visit(48, "wait_us", h.wait_us);
        visit(52, "trace_us", h.trace_us);
        visit(56, "denoise_us", h.denoise_us);
        visit(60, "encode_us", h.encode_us);
        visit(64, "nonfinite_count", h.nonfinite_count);
        visit(68, "scene_time", h.scene_time);
        visit(72, "framebuffer_hash", h.framebuffer_hash);
    }
};

/// A frame message taken apart. `payload` points into the message.
struct FrameView {
    FrameHeader header;
    std::span<const std::byte> payload;
};

/// Fixed part and pass table; the payload of header.payload_size bytes is to follow at once.
/// Asserts at most kMaxPasses passes; longer names are cut to kMaxPassNameBytes.
std::vector<std::byte> encode_frame_header(const FrameHeader& header);

/// A whole binary message. Refuses anything but exactly header, pass table and payload.
Decoded<FrameView> decode_frame(std::span<const std::byte> message);

}  // namespace farlight::protocol
