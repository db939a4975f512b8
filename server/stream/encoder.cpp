// Encoder: see the header.
#include "server/stream/encoder.h"

#include "server/stream/image_codecs.h"

#include <bit>
#include <cassert>
#include <chrono>
#include <exception>
#include <xxhash.h>

namespace farlight {
namespace {

using protocol::Format;

void append_payload(std::vector<std::uint8_t>& bytes, const EncodeTask& task)
{
    switch (task.header.format) {
    case Format::kJpeg420: return append_jpeg(bytes, task.image, task.jpeg_quality, Chroma::k420);
    case Format::kJpeg444: return append_jpeg(bytes, task.image, task.jpeg_quality, Chroma::k444);
    case Format::kPng: return append_png(bytes, task.image);
    case Format::kRaw: {
        static_assert(std::endian::native == std::endian::little, "raw floats go out as they are");
        const auto* first = reinterpret_cast<const std::uint8_t*>(task.image.bytes.data());
        bytes.assign(first, first + task.image.bytes.size());
        return;
    }
    }
}

}  // namespace

EncodedFrame encode_frame(const EncodeTask& task)
{
    const Image& image = task.image;
    assert(image.format == pixel_format_for(task.header.format));
    const auto start = std::chrono::steady_clock::now();

    EncodedFrame encoded{.header = task.header};
    try {
        append_payload(encoded.payload, task);
    } catch (const std::exception& problem) {
        encoded.payload.clear();
        encoded.error = problem.what();
    }
    protocol::FrameHeader& header = encoded.header;
    header.width = static_cast<std::uint16_t>(image.extent.width);
    header.height = static_cast<std::uint16_t>(image.extent.height);
    header.full_width = static_cast<std::uint16_t>(image.full_extent.width);
    header.full_height = static_cast<std::uint16_t>(image.full_extent.height);
    header.framebuffer_hash = XXH64(image.bytes.data(), image.bytes.size(), 0);
    header.payload_size = static_cast<std::uint32_t>(encoded.payload.size());
    header.encode_us =
        static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(
            std::chrono::steady_clock::now() - start)
                                       .count());
    return encoded;
}

PixelFormat pixel_format_for(protocol::Format format)
{
    return format == Format::kRaw ? PixelFormat::kRgb32f : PixelFormat::kRgb8;
}

bool is_lossless(protocol::Format format)
{
    return format == Format::kPng || format == Format::kRaw;
}

}  // namespace farlight
