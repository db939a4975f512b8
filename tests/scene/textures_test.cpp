// Mip levels, and the way images share arrays.
#include "server/gl/gl_error.h"
#include "server/scene/textures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

Image8 image_of(std::uint32_t width, std::uint32_t height, const glm::u8vec4& texel)
{
    return {"image", width, height, std::vector<glm::u8vec4>(std::size_t{width} * height, texel)};
}

Image8 random_image(std::uint32_t width, std::uint32_t height, unsigned seed)
{
    std::mt19937 random(seed);
    Image8 image = image_of(width, height, {});
    for (glm::u8vec4& texel : image.texels)
        texel = glm::u8vec4(random(), random(), random(), random());
    return image;
}

TEST(TextureMips, DecodeTheStandardsCurve)
{
    // IEC 61966-2-1: code 188 is 0.5028865, code 10 lies on the straight part.
    const glm::vec4 value = decoded({188, 10, 255, 128}, TexelSpace::kSrgb);
    EXPECT_NEAR(value.x, 0.5028865, 1e-6);
    EXPECT_NEAR(value.y, 10 / 255.0 / 12.92, 1e-7);
    EXPECT_EQ(value.z, 1);
    EXPECT_NEAR(value.w, 128 / 255.0, 1e-6);  // alpha is linear
    EXPECT_NEAR(decoded({188, 0, 0, 0}, TexelSpace::kLinear).x, 188 / 255.0, 1e-6);
}

TEST(TextureMips, HaveHalfTheSizeDownToOneTexel)
{
    std::vector<glm::uvec2> sizes;
    for (const Image8& level : mip_levels(random_image(13, 3, 1), TexelSpace::kLinear))
        sizes.emplace_back(level.width, level.height);
    EXPECT_THAT(sizes,
        testing::ElementsAre(
            glm::uvec2(13, 3), glm::uvec2(6, 1), glm::uvec2(3, 1), glm::uvec2(1, 1)));
}

TEST(TextureMips, AverageInLinearLight)
{
    Image8 image = image_of(2, 2, {0, 0, 0, 255});
    image.texels[1] = image.texels[2] = {255, 255, 255, 255};
    EXPECT_EQ(mip_levels(image, TexelSpace::kSrgb)[1].texels[0], glm::u8vec4(188, 188, 188, 255));
    EXPECT_EQ(mip_levels(image, TexelSpace::kLinear)[1].texels[0], glm::u8vec4(128, 128, 128, 255));
}

/// Every level keeps the image's mean, whatever its size: the boxes tile the image.
TEST(TextureMips, EveryLevelKeepsTheMean)
{
    for (const auto& [width, height] : {std::pair{16U, 16U}, {13U, 7U}, {1U, 9U}, {31U, 2U}})
        for (const TexelSpace space : {TexelSpace::kSrgb, TexelSpace::kLinear}) {
            const Image8 image = random_image(width, height, width);
            const glm::vec4 mean = mean_texel(image, space);
            for (const Image8& level : mip_levels(image, space))
                for (int c = 0; c < 4; ++c)
                    // Rounding to a code is off by half a code at most: 1/510, at the bright end of
                    // sRGB, where the curve is steepest, 2.3 times that.
                    EXPECT_NEAR(mean_texel(level, space)[c], mean[c], 2.3 / 510)
                        << width << "x" << height << " at " << level.width;
        }
}

TEST(TextureMips, AConstantStaysExact)
{
    for (int code = 0; code < 256; ++code) {
        const auto c = static_cast<std::uint8_t>(code);
        for (const Image8& level : mip_levels(image_of(5, 3, glm::u8vec4(c)), TexelSpace::kSrgb))
            for (const glm::u8vec4& texel : level.texels)
                ASSERT_EQ(texel, glm::u8vec4(c)) << code;
    }
}

Texture texture_of(std::uint32_t image)
{
    Texture texture;
    texture.image = image;
    return texture;
}

TEST(TextureLayouts, GroupBySizeClassAndSpace)
{
    const std::vector<Image8> images{
        image_of(5, 3, {}), image_of(8, 4, {}), image_of(8, 5, {}), image_of(1, 1, {})};
    TextureLayout layout(images);
    for (std::uint32_t i = 0; i < 3; ++i)
        layout.need(texture_of(i), TexelSpace::kSrgb);
    layout.need(texture_of(1), TexelSpace::kLinear);
    layout.need(texture_of(1), TexelSpace::kLinear);
    layout.need(Texture(), TexelSpace::kLinear);
    layout.lay_out({});
    ASSERT_EQ(layout.arrays().size(), 3U);
    std::map<std::pair<std::uint32_t, TexelSpace>, std::size_t> layers;
    for (const TextureArrayLayout& array : layout.arrays()) {
        EXPECT_EQ(array.width, 8U);
        layers[{array.height, array.space}] = array.images.size();
    }
    EXPECT_EQ((layers[{4, TexelSpace::kSrgb}]), 2U);  // 5x3 and 8x4
    EXPECT_EQ((layers[{5, TexelSpace::kSrgb}]), 1U);  // 8x5, in no more than it needs
    EXPECT_EQ((layers[{4, TexelSpace::kLinear}]), 1U);  // the same image again, read differently
    EXPECT_NE(layout.packed(texture_of(1), TexelSpace::kLinear)[0].x,
        layout.packed(texture_of(1), TexelSpace::kSrgb)[0].x);
    EXPECT_EQ(layout.packed(Texture(), TexelSpace::kSrgb)[0], glm::uvec4(0));
}

TEST(TextureLayouts, JoinWhatWastesLeastWhenThereAreTooManySizes)
{
    std::vector<Image8> images;
    for (std::uint32_t size = 1; size <= 512; size *= 2)
        images.push_back(image_of(size, size, {}));
    TextureLayout layout(images);
    for (std::uint32_t i = 0; i < images.size(); ++i)
        layout.need(texture_of(i), TexelSpace::kSrgb);
    layout.lay_out({});
    ASSERT_EQ(layout.arrays().size(), std::size_t{TEXTURE_ARRAYS});
    std::map<std::uint32_t, std::size_t> layers;
    for (const TextureArrayLayout& array : layout.arrays())
        layers[array.width] = array.images.size();
    EXPECT_EQ(layers[512], 1U);  // the largest are left alone
    EXPECT_EQ(layers[256], 1U);
    EXPECT_EQ(layers[16], 5U);  // 1, 2, 4, 8 and 16 share
}

std::string refusal(const std::vector<Image8>& images, const TextureLimits& limits)
{
    TextureLayout layout(images);
    for (std::uint32_t i = 0; i < images.size(); ++i)
        layout.need(texture_of(i), TexelSpace::kSrgb);
    try {
        layout.lay_out(limits);
    } catch (const GlError& error) {
        return error.what();
    }
    return "";
}

TEST(TextureLayouts, RefuseWhatTheDeviceCannotHoldNamingLimitAndNeed)
{
    using testing::AllOf;
    using testing::HasSubstr;
    EXPECT_THAT(refusal({image_of(33, 2, {})}, {32, 8}),
        AllOf(HasSubstr("'image'"), HasSubstr("33x2"), HasSubstr("32x32")));
    EXPECT_THAT(refusal(std::vector<Image8>(6 * 8 + 1, image_of(4, 4, {})), {32, 8}),
        AllOf(HasSubstr("49 images"), HasSubstr("7 texture arrays"), HasSubstr("8 layers")));
    EXPECT_EQ(refusal(std::vector<Image8>(6 * 8, image_of(4, 4, {})), {32, 8}), "");
    // Seven sizes of as many layers as there may be: no two may be joined.
    std::vector<Image8> images;
    for (std::uint32_t size = 1; size <= 64; size *= 2)
        images.push_back(image_of(size, size, {}));
    EXPECT_THAT(
        refusal(images, {64, 1}), AllOf(HasSubstr("7 texture arrays"), HasSubstr("1 layers")));
}

TEST(TextureLayouts, SplitWhatHasMoreImagesThanAnArrayHasLayers)
{
    const std::vector<Image8> images(5, image_of(4, 4, {}));
    TextureLayout layout(images);
    for (std::uint32_t i = 0; i < images.size(); ++i)
        layout.need(texture_of(i), TexelSpace::kSrgb);
    layout.lay_out({32, 2});
    ASSERT_EQ(layout.arrays().size(), 3U);
    std::vector<std::uint32_t> placed;
    for (std::uint32_t a = 0; a < 3; ++a) {
        const std::vector<std::uint32_t>& layers = layout.arrays()[a].images;
        EXPECT_LE(layers.size(), 2U);
        for (std::uint32_t layer = 0; layer < layers.size(); ++layer) {
            const std::uint32_t word =
                layout.packed(texture_of(layers[layer]), TexelSpace::kSrgb)[0].x;
            EXPECT_EQ(word >> TEXTURE_ARRAY_SHIFT & 7U, a);
            EXPECT_EQ(word & 0xffffU, layer);
            placed.push_back(layers[layer]);
        }
    }
    EXPECT_THAT(placed, testing::UnorderedElementsAre(0, 1, 2, 3, 4));
}

TEST(TextureLayouts, ReportTheBytesOfAllLevels)
{
    const TextureArrayLayout array{TexelSpace::kLinear, 8, 2, {0, 1, 2}};
    EXPECT_EQ(array.levels(), 4U);
    EXPECT_EQ(array.bytes(), 3U * 4 * (16 + 4 + 2 + 1));
}

}  // namespace
}  // namespace farlight
