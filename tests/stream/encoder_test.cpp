// Encoder: what goes in comes out, exactly for PNG and raw, closely for JPEG.
#include "server/stream/encoder.h"
#include "tests/stream/fake_renderer.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <random>
#include <stb/stb_image.h>
#include <turbojpeg.h>
#include <xxhash.h>

namespace farlight {
namespace {

using protocol::Format;

Image picture(Extent extent, PixelFormat format)
{
    RenderRequest request;
    request.extent = extent;
    request.format = format;
    return fake_picture(request, 0);
}

EncodedFrame encode(Image image, Format format, int quality = 90)
{
    EncodeTask task{std::move(image), {}, quality};
    task.header.format = format;
    return encode_frame(task);
}

/// Peak signal-to-noise ratio of the decoded payload [dB].
double psnr_after_jpeg(const Image& image, Format format, int quality)
{
    const EncodedFrame frame = encode(image, format, quality);
    std::vector<unsigned char> decoded(image.bytes.size());
    const tjhandle decompressor = tjInitDecompress();
    const int failed = tjDecompress2(decompressor, frame.payload.data(), frame.payload.size(),
        decoded.data(), image.extent.width, 0, image.extent.height, TJPF_RGB, 0);
    EXPECT_EQ(failed, 0) << tjGetErrorStr2(decompressor);
    tjDestroy(decompressor);
    double squares = 0;
    for (std::size_t i = 0; i < decoded.size(); ++i)
        squares += std::pow(decoded[i] - std::to_integer<int>(image.bytes[i]), 2);
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(decoded.size()) / squares);
}

std::vector<std::byte> decode_png(const std::vector<std::uint8_t>& png, Extent expected)
{
    int width = 0;
    int height = 0;
    int channels = 0;
    stbi_uc* pixels = stbi_load_from_memory(
        png.data(), static_cast<int>(png.size()), &width, &height, &channels, 3);
    EXPECT_NE(pixels, nullptr);
    EXPECT_EQ((Extent{width, height}), expected);
    const auto* first = reinterpret_cast<const std::byte*>(pixels);
    std::vector<std::byte> bytes(first, first + 3L * width * height);
    stbi_image_free(pixels);
    return bytes;
}

class LosslessSizes : public testing::TestWithParam<Extent> { };

TEST_P(LosslessSizes, PngComesBackBitByBit)
{
    const Image image = picture(GetParam(), PixelFormat::kRgb8);
    const EncodedFrame frame = encode(image, Format::kPng);
    EXPECT_EQ(frame.error, "");
    EXPECT_EQ(decode_png(frame.payload, image.extent), image.bytes);
    EXPECT_EQ(frame.header.framebuffer_hash, XXH64(image.bytes.data(), image.bytes.size(), 0));
}

TEST_P(LosslessSizes, RawComesBackBitByBit)
{
    const Image image = picture(GetParam(), PixelFormat::kRgb32f);
    const EncodedFrame frame = encode(image, Format::kRaw);
    ASSERT_EQ(frame.payload.size(), image.bytes.size());
    EXPECT_EQ(std::memcmp(frame.payload.data(), image.bytes.data(), image.bytes.size()), 0);
    EXPECT_EQ(frame.header.payload_size, image.bytes.size());
    EXPECT_EQ(frame.header.framebuffer_hash, XXH64(image.bytes.data(), image.bytes.size(), 0));
}

INSTANTIATE_TEST_SUITE_P(Sizes, LosslessSizes,
    testing::Values(Extent{1, 1}, Extent{3, 2}, Extent{17, 31}, Extent{320, 180}),
    [](const auto& parameter) {
        return std::to_string(parameter.param.width) + "x" + std::to_string(parameter.param.height);
    });

TEST(Encoder, PngOfNoiseComesBackBitByBit)
{
    std::mt19937 random(1);
    Image image = picture({160, 90}, PixelFormat::kRgb8);
    for (std::byte& byte : image.bytes)
        byte = static_cast<std::byte>(random());
    EXPECT_EQ(decode_png(encode(image, Format::kPng).payload, image.extent), image.bytes);
}

TEST(Encoder, JpegIsClose)
{
    // A smooth picture; 35 dB is where differences begin to be seen.
    const Image image = picture({320, 180}, PixelFormat::kRgb8);
    EXPECT_GT(psnr_after_jpeg(image, Format::kJpeg420, 90), 35);
    EXPECT_GT(psnr_after_jpeg(image, Format::kJpeg444, 90), 35);
    EXPECT_GT(
        psnr_after_jpeg(image, Format::kJpeg444, 95), psnr_after_jpeg(image, Format::kJpeg444, 30));
}

TEST(Encoder, FullChromaKeepsThinColouredLines)
{
    Image image = picture({160, 90}, PixelFormat::kRgb8);
    for (std::size_t i = 0; i < image.bytes.size(); i += 3) {  // red lines on blue, 1 pixel wide
        const bool red = i / 3 % 160 % 4 == 0;
        image.bytes[i] = std::byte(red ? 255 : 0);
        image.bytes[i + 1] = std::byte(0);
        image.bytes[i + 2] = std::byte(red ? 0 : 255);
    }
    EXPECT_GT(psnr_after_jpeg(image, Format::kJpeg444, 92),
        psnr_after_jpeg(image, Format::kJpeg420, 92) + 10);
}

TEST(Encoder, FillsInSizesAndKeepsWhatItWasGiven)
{
    EncodeTask task{picture({64, 36}, PixelFormat::kRgb8), {}, 80};
    task.image.full_extent = {128, 72};
    task.header.camera_sequence = 41;
    task.header.passes = {{"gbuffer", 1.5F}};
    const EncodedFrame frame = encode_frame(task);
    EXPECT_EQ(frame.header.width, 64);
    EXPECT_EQ(frame.header.height, 36);
    EXPECT_EQ(frame.header.full_height, 72);
    EXPECT_EQ(frame.header.payload_size, frame.payload.size());
    EXPECT_EQ(frame.header.camera_sequence, 41U);
    EXPECT_EQ(frame.header.passes.size(), 1U);
}

TEST(Encoder, AnImageThatJpegCannotHoldIsAnErrorNotACrash)
{
    Image image{{70000, 1}, PixelFormat::kRgb8, std::vector<std::byte>(210000)};
    const EncodedFrame frame = encode(std::move(image), Format::kJpeg420);
    EXPECT_NE(frame.error, "");
    EXPECT_TRUE(frame.payload.empty());
}

}  // namespace
}  // namespace farlight
