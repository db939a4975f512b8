// Picture files: the shipped ones hold what tools/make_scene_files.py computes; broken ones are
// refused.
#include "lab/temp_folder.h"
#include "server/scene/image_file.h"
#include "server/scene/json_text.h"
#include "tests/scene/png.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>
#include <numbers>

namespace farlight {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";

std::span<const unsigned char> bytes_of(const std::string& text)
{
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

TEST(ImageFile, SixteenBitsBecomeEight)
{
    const std::string png = png16(2, 1, {0, 257, 65535, 32896, 65535, 0, 0, 65535});
    const Image8 image = decode_image(bytes_of(png), {"a.png", {}});
    EXPECT_THAT(image.texels,
        testing::ElementsAre(glm::u8vec4(0, 1, 255, 128), glm::u8vec4(255, 0, 0, 255)));
}

TEST(ImageFile, AMissingAlphaIsOpaque)
{
    const Image8 image = read_image(kScenes / "letter.png");
    EXPECT_EQ(image.name, "letter.png");
    ASSERT_EQ(image.texels.size(), 64U);
    EXPECT_EQ(image.texels[0], glm::u8vec4(30, 60, 130, 255));
    EXPECT_EQ(image.texels[8 + 1], glm::u8vec4(240, 190, 40, 255));  // the F's upper left
}

TEST(ImageFile, OpenExrHoldsTheLinearSky)
{
    const EnvironmentFile file = read_environment_map(kScenes / "linear_sky.exr");
    EXPECT_EQ(file.repaired_texels, 0U);
    EXPECT_EQ(file.map.width, 8U);
    ASSERT_EQ(file.map.height, 32U);
    for (std::uint32_t row = 0; row < 32; ++row) {
        const double y = 0.5
            * (std::cos(std::numbers::pi * row / 32) + std::cos(std::numbers::pi * (row + 1) / 32));
        for (std::uint32_t x = 0; x < 8; ++x)
            for (int channel = 0; channel < 3; ++channel)
                // 32-bit floats in the file
                EXPECT_FLOAT_EQ(file.map.texels[row * 8 + x][channel], float(1 + 0.8 * y));
    }
}

TEST(ImageFile, RadianceHdrHoldsTheEveningSky)
{
    const EnvironmentFile file = read_environment_map(kScenes / "evening.hdr");
    EXPECT_EQ(file.map.width, 128U);
    EXPECT_EQ(file.map.height, 64U);
    EXPECT_EQ(file.repaired_texels, 0U);
    // The sun is at (0.55, 0.42, 0.72): u = 0.5 + atan2(x, -z) / 2 pi, v = acos(y) / pi.
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.55, 0.42, 0.72));
    const double u = 0.5 + std::atan2(sun.x, -sun.z) / (2 * std::numbers::pi);
    const double v = std::acos(sun.y) / std::numbers::pi;
    const glm::vec3 at = file.map.texels[std::size_t(v * 64) * 128 + std::size_t(u * 128)];
    EXPECT_NEAR(at.x, 190, 1);  // of 8 bits of mantissa
    EXPECT_NEAR(at.y, 150, 1);
    EXPECT_NEAR(at.z, 100, 1);
    const glm::vec3 ground = file.map.texels[63 * 128];
    EXPECT_NEAR(ground.x, 0.04, 0.01);
}

/// As a Radiance file without run lengths.
std::string flat_hdr(int width, int height, const std::string& texels)
{
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X "
        + std::to_string(width) + "\n" + texels;
}

TEST(ImageFile, BrightTexelsAreBounded)
{
    const TempFolder folder;
    // 255 * 2^(255 - 136) is about 1.7e38, beyond what may be squared.
    const auto file = folder.write("a.hdr",
        flat_hdr(2, 1, std::string("\xff\xff\xff\xff", 4) + std::string("\x80\x80\x80\x81", 4)));
    const EnvironmentFile read = read_environment_map(file);
    EXPECT_EQ(read.repaired_texels, 1U);
    EXPECT_EQ(read.map.texels[0], glm::vec3(1e18F));
    EXPECT_EQ(read.map.texels[1], glm::vec3(1));
}

TEST(ImageFile, WhatIsNoPictureIsRefused)
{
    const TempFolder folder;
    const auto refusal_for = [](const std::filesystem::path& file) {
        return refusal(file.string(), [&] { read_image(file); });
    };
    EXPECT_EQ(
        refusal_for(folder.write("empty.png", "")), "found an empty file, expected a picture");
    EXPECT_EQ(refusal_for(folder.write("text.png", "hello")),
        "found no picture: unknown image type, expected a PNG or JPEG picture");
    for (const std::size_t byte : {16, 17, 18}) {  // of the width, from the largest
        std::string huge = png8(1, 1, {1, 2, 3, 4});
        huge[byte] = '\x7f';
        EXPECT_THAT(refusal_for(folder.write("huge.png", huge)),
            testing::EndsWith("expected at least 1 and at most 16384 texels a side"))
            << byte;
    }
    const auto png = folder.write("sky.png", png8(1, 1, {1, 2, 3, 4}));
    EXPECT_EQ(refusal(png.string(), [&] { read_environment_map(png); }),
        "found neither of the two, expected a Radiance HDR (.hdr) or OpenEXR (.exr) picture");
}

/// However a file is cut off, it is refused or read; nothing is read beyond its end (asan).
TEST(ImageFile, CutOffFilesDoNoHarm)
{
    const TempFolder folder;
    for (const char* const name : {"tiles.png", "evening.hdr", "linear_sky.exr"}) {
        const std::string whole = read_file(kScenes / name);
        int refused = 0;
        for (std::size_t length = 1; length < whole.size(); length += 1 + length / 16) {
            const auto file = folder.write(name, whole.substr(0, length));
            try {
                if (std::string(name).ends_with("png"))
                    read_image(file);
                else
                    read_environment_map(file);
            } catch (const SceneError&) {
                ++refused;
            }
        }
        EXPECT_GT(refused, 10) << name;  // all but some of those of which stb makes a part
    }
}

}  // namespace
}  // namespace farlight
