// Triangles so small that single precision finds no area in them.
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

/// 1e-12 wide: the square of the cross product is below the smallest float. It fills the picture.
Scene slivers(bool moving)
{
    Scene scene;
    scene.materials.push_back({"white", glm::vec3(0.5F), glm::vec3(0.25F), true});
    scene.meshes.push_back(
        {"sliver", {{-6e-13F, -4e-13F, 0}, {6e-13F, -4e-13F, 0}, {0, 8e-13F, 0}}, {}, {{0, 1, 2}}});
    scene.objects.push_back({"sliver", 0, MeshInstance{}});
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0, 2e-13}, {0, 0, 0}, {0, 1, 0}, 45};
    if (moving) {
        scene.animation.nodes.emplace_back();
        Track track;
        track.times = {0, 1};
        track.values = {0, 0, 0, 0, 0, 1e-13F};
        scene.animation.tracks.push_back(track);
        scene.objects[0].node = 0;
    }
    return scene;
}

class SliverTest : public GlTest, public testing::WithParamInterface<bool> { };

TEST_P(SliverTest, FacesWhoeverLooks)
{
    constexpr Extent kRows{16, 9};
    const DeviceScene scene(slivers(GetParam()));
    const auto frame_of = [&](DebugView which) {
        RenderRequest request = linear_request(scene.scene, kRows, {});
        request.settings.denoiser = Denoiser::kOff;
        request.settings.antialiasing = false;
        request.settings.view = which;
        View view(scene.shared);
        return view.render(request);
    };
    const RenderedFrame final = frame_of(DebugView::kFinal);
    const RenderedFrame normals = frame_of(DebugView::kGeometricNormal);
    const RenderedFrame depth = frame_of(DebugView::kDepth);
    EXPECT_EQ(final.nonfinite_count, 0U);
    for (int x = 0; x < kRows.width; ++x) {
        ASSERT_NEAR(pixel(depth.image, x, 4).x / 2e-13, 1, 1e-3) << "the row has to meet it";
        EXPECT_NEAR(glm::length(pixel(normals.image, x, 4)), 1, 1e-3) << x;
        EXPECT_GT(pixel(normals.image, x, 4).z, 0) << x;
        EXPECT_GT(pixel(final.image, x, 4).x, 0.25F) << x;
    }
}

INSTANTIATE_TEST_SUITE_P(Slivers, SliverTest, testing::Bool(),
    [](const auto& test) { return test.param ? "Moving" : "AtRest"; });

}  // namespace
}  // namespace farlight
