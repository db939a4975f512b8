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
/// [bytes] of the fixed part this version writes, without its table of stages.
constexpr std::uint16_t kFrameHeaderSize = 136;
/// The fixed part that every v1 header has; fields beyond a header's end keep their defaults.
constexpr std::uint16_t kSmallestFrameHeaderSize = 80;
constexpr std::size_t kMaxPasses = 256;
constexpr std::size_t kMaxStages = 256;
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

/// Pixels in which a stage met values that no healthy frame has.
struct StageEntry {
    std::string name;
    std::uint32_t nan = 0;
    std::uint32_t infinite = 0;
    std::uint32_t negative = 0;
    std::uint32_t clamped = 0;

    bool operator==(const StageEntry&) const = default;

    static void each_count(auto& s, auto&& visit)
    {
        visit(s.nan, "nan");
        visit(s.infinite, "infinite");
        visit(s.negative, "negative");
        visit(s.clamped, "clamped");
    }
};

/// What estimates are before there is any.
constexpr float kNotEstimated = std::numeric_limits<float>::quiet_NaN();

struct FrameHeader {
    Format format = Format::kJpeg420;
    std::uint16_t flags = 0;
    std::uint32_t frame_id = 0;  ///< Counts up by one a frame sent, from 1, per connection; wraps.
    std::uint32_t camera_sequence =
        0;  ///< Of the newest camera message in the picture; 0 before any.
    std::uint32_t session_epoch = 0;  ///< Counts up whenever size or scene change.
    std::uint32_t payload_size = 0;  ///< [bytes]
    std::uint16_t width = 0;  ///< [px] of the payload.
    std::uint16_t height = 0;
    std::uint16_t full_width = 0;  ///< [px] the payload is to be shown at.
    std::uint16_t full_height = 0;
    std::uint32_t accumulated_samples = 0;
    float predicted_error = kNotEstimated;  ///< relMSE, from the frames' own samples.
    std::uint32_t wait_us = 0;
    std::uint32_t trace_us = 0;
    std::uint32_t denoise_us = 0;
    std::uint32_t encode_us = 0;
    std::uint32_t nonfinite_count = 0;  ///< Of all stages, as the two below.
    float scene_time = 0;  ///< [s] that the picture shows; 0 where nothing follows time.
    std::uint64_t framebuffer_hash = 0;  ///< XXH64, seed 0, of the unencoded pixel bytes.
    float predicted_lower = kNotEstimated;  ///< 95 % interval of predicted_error.
    float predicted_upper = kNotEstimated;
    float measured_error = kNotEstimated;  ///< relMSE against an independent mean.
    float measured_lower = kNotEstimated;  ///< 95 % interval of measured_error.
    float measured_upper = kNotEstimated;
    std::uint32_t reference_samples = 0;  ///< A pixel, in the mean behind measured_error.
    float effective_samples = kNotEstimated;  ///< A pixel, that a plain mean needs for this error.
    float raw_error = kNotEstimated;  ///< relMSE of this frame's own samples without any filter.
    std::uint32_t frame_us = 0;  ///< Whole frame on the device, what passes leave out included.
    std::uint16_t samples_per_pixel = 0;  ///< In effect.
    float noise_error = kNotEstimated;  ///< The part of predicted_error that is noise.
    std::uint32_t negative_count = 0;
    std::uint32_t clamped_count = 0;
    std::uint16_t rung = 0;  ///< 1-based point of the newest `frontier` that drew it; 0: none.

    std::vector<StageEntry> stages;  ///< Those that met such values, in the order of a frame.
    std::vector<PassEntry> passes;  ///< In execution order.

    bool has(std::uint16_t flag) const { return (flags & flag) != 0; }

    /// visit(offset [bytes], name, member) for the fields of the fixed part that a picture decides;
    /// magic, version, header_size, stage_count, pass_count and passes_size follow from the rest.
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
        visit(80, "predicted_lower", h.predicted_lower);
        visit(84, "predicted_upper", h.predicted_upper);
        visit(88, "measured_error", h.measured_error);
        visit(92, "measured_lower", h.measured_lower);
        visit(96, "measured_upper", h.measured_upper);
        visit(100, "reference_samples", h.reference_samples);
        visit(104, "effective_samples", h.effective_samples);
        visit(108, "raw_error", h.raw_error);
        visit(112, "frame_us", h.frame_us);
        visit(116, "samples_per_pixel", h.samples_per_pixel);
        visit(118, "rung", h.rung);
        visit(120, "noise_error", h.noise_error);
        visit(124, "negative_count", h.negative_count);
        visit(128, "clamped_count", h.clamped_count);
    }
};

/// A frame message taken apart. `payload` points into the message.
struct FrameView {
    FrameHeader header;
    std::span<const std::byte> payload;
};

/// Fixed part, tables of stages and passes; the payload of header.payload_size bytes is to follow
/// at once. Asserts at most kMaxStages stages and kMaxPasses passes; longer names are cut to
/// kMaxPassNameBytes.
std::vector<std::byte> encode_frame_header(const FrameHeader& header);

/// A whole binary message. Refuses anything but exactly header, pass table and payload.
Decoded<FrameView> decode_frame(std::span<const std::byte> message);

}  // namespace farlight::protocol
