// Payload -> pixels, by libjpeg-turbo and stb.
#include "client/picture.h"

#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <stb/stb_image.h>
#include <turbojpeg.h>
#include <xxhash.h>

namespace farlight::client {
namespace {

using protocol::Format;
using protocol::FrameHeader;

std::string size_text(int width, int height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

void expect_size(const FrameHeader& header, int width, int height, const char* kind)
{
    if (width != header.width || height != header.height)
        throw PictureError(std::string(kind) + ": found " + size_text(width, height) + ", expected "
            + size_text(header.width, header.height));
}

const unsigned char* bytes_of(std::span<const std::byte> payload)
{
    return reinterpret_cast<const unsigned char*>(payload.data());
}

std::vector<std::uint8_t> decode_jpeg(const FrameHeader& header, std::span<const std::byte> payload)
{
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), &tjDestroy);
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colors = 0;
    if (tjDecompressHeader3(decoder.get(), bytes_of(payload), payload.size(), &width, &height,
            &subsampling, &colors)
        != 0)
        throw PictureError(std::string("JPEG: ") + tjGetErrorStr2(decoder.get()));
    expect_size(header, width, height, "JPEG");
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * height * 3);
    if (tjDecompress2(decoder.get(), bytes_of(payload), payload.size(), pixels.data(), width, 0,
            height, TJPF_RGB, 0)
        != 0)
        throw PictureError(std::string("JPEG: ") + tjGetErrorStr2(decoder.get()));
    return pixels;
}

std::vector<std::uint8_t> decode_png(const FrameHeader& header, std::span<const std::byte> payload)
{
    if (payload.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw PictureError("PNG: too large");
    const int length = static_cast<int>(payload.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(bytes_of(payload), length, &width, &height, &channels) == 0)
        throw PictureError(std::string("PNG: ") + stbi_failure_reason());
    expect_size(header, width, height, "PNG");
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes_of(payload), length, &width, &height, &channels, 3),
        &stbi_image_free);
    if (!pixels)
        throw PictureError(std::string("PNG: ") + stbi_failure_reason());
    return {pixels.get(), pixels.get() + static_cast<std::size_t>(width) * height * 3};
}

std::vector<float> decode_raw(const FrameHeader& header, std::span<const std::byte> payload)
{
    static_assert(std::endian::native == std::endian::little, "raw frames are little-endian");
    std::vector<float> values(static_cast<std::size_t>(header.width) * header.height * 3);
    if (payload.size() != values.size() * sizeof(float))
        throw PictureError("raw: found " + std::to_string(payload.size()) + " bytes, expected "
            + std::to_string(values.size() * sizeof(float)));
    if (!values.empty())
        std::memcpy(values.data(), payload.data(), payload.size());
    return values;
}

}  // namespace

Picture decode_picture(const FrameHeader& header, std::span<const std::byte> payload)
{
    Picture picture{.width = header.width, .height = header.height, .linear = {}, .display = {}};
    switch (header.format) {
    case Format::kJpeg420:
    case Format::kJpeg444: picture.display = decode_jpeg(header, payload); break;
    case Format::kPng: picture.display = decode_png(header, payload); break;
    case Format::kRaw: picture.linear = decode_raw(header, payload); break;
    }
    return picture;
}

std::uint64_t hash_bytes(std::span<const std::byte> bytes)
{
    return XXH64(bytes.data(), bytes.size(), 0);
}

std::uint64_t hash_pixels(const Picture& picture)
{
    return picture.linear.empty() ? hash_bytes(std::as_bytes(std::span(picture.display)))
                                  : hash_bytes(std::as_bytes(std::span(picture.linear)));
}

}  // namespace farlight::client
