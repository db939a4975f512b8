// Scenes larger than a device allows: split where they can be, else refused with the limit and the
// need. The device here is the usual one with lower limits.
#include "lab/meshes.h"
#include "server/gl/gl_error.h"
#include "server/scene/neutral.h"
#include "tests/support/gl_test.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A square with its own texture for each of `images` images of one size.
Scene many_images(std::uint32_t images)
{
    Scene scene;
    for (std::uint32_t i = 0; i < images; ++i) {
        const auto shade = static_cast<std::uint8_t>(40 * i + 10);
        scene.images.push_back({"image", 2, 1, {{shade, 200, 30, 255}, {20, shade, 90, 255}}});
        Material material{"square"};
        material.albedo_texture.image = i;
        scene.materials.push_back(material);
        scene.objects.push_back(
            {"square", i, Quad{{i - 0.5 * images, -0.5, 0}, {0.9, 0, 0}, {0, 1, 0}}});
    }
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0, 6}, {0, 0, 0}, {0, 1, 0}, 60};
    return scene;
}

/// The message with which the scene is refused; empty if it is not.
std::string refused(Scene scene, const DeviceLimits& limits)
{
    drop_neutral(scene);
    try {
        const GpuScene on_device(scene, limits);
    } catch (const GlError& error) {
        return error.what();
    }
    return "";
}

class DeviceLimitsTest : public GlTest { };

/// Every table, the largest first: one texel too few for it is refused by its name.
TEST_F(DeviceLimitsTest, ATableThatNoBufferTextureHoldsIsRefusedByNameLimitAndNeed)
{
    Scene scene = shipped_scene("everything.json");
    drop_neutral(scene);
    const PackedScene packed = pack_scene(scene);
    std::size_t need = 0;
    const char* largest = nullptr;
    for (const auto& [name, texels] : packed.tables())
        if (texels->size() > need)
            need = texels->size(), largest = name;
    ASSERT_NE(largest, nullptr);
    EXPECT_EQ(refused(scene, {{}, need}), "");
    EXPECT_THAT(refused(scene, {{}, need - 1}),
        AllOf(HasSubstr("'" + std::string(largest) + "'"),
            HasSubstr("needs " + std::to_string(need) + " texels"),
            HasSubstr("allows " + std::to_string(need - 1))));
}

TEST_F(DeviceLimitsTest, ImagesThatNoArraysHoldAreRefusedWithLimitAndNeed)
{
    DeviceLimits limits = device_limits();
    limits.textures.layers = 2;
    EXPECT_EQ(refused(many_images(6), limits), "");
    limits.textures.layers = 1;
    EXPECT_THAT(refused(many_images(7), limits),
        AllOf(HasSubstr("7 images"), HasSubstr("7 texture arrays"), HasSubstr("1 layers")));
    limits.textures.size = 1;
    EXPECT_THAT(refused(many_images(1), limits), AllOf(HasSubstr("2x1"), HasSubstr("1x1")));
}

/// Images split over several arrays look as they do in one.
TEST_F(DeviceLimitsTest, ASceneSplitOverArraysLooksTheSame)
{
    DeviceLimits limits = device_limits();
    limits.textures.layers = 2;
    const DeviceScene whole(many_images(5));
    const DeviceScene split(many_images(5), limits);
    const auto picture = [](const DeviceScene& scene) {
        View view(scene.shared);
        RenderSettings settings;
        settings.view = DebugView::kAlbedo;
        return view.render(linear_request(scene.scene, {60, 40}, settings)).image.bytes;
    };
    const auto arrays = [](const DeviceScene& scene) {
        return std::count_if(scene.shared.gpu->allocations().begin(),
            scene.shared.gpu->allocations().end(),
            [](const Allocation& held) { return held.name.starts_with("texture_array_"); });
    };
    EXPECT_EQ(arrays(whole), 1);
    EXPECT_EQ(arrays(split), 3);
    EXPECT_EQ(picture(whole), picture(split));
}

}  // namespace
}  // namespace farlight
