// The G-buffer against a double-precision camera on the CPU: motion, depth and its gradient.
#include "lab/projection.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

constexpr Extent kGbufferExtent{97, 61};

Image view_of(View& view, const Scene& scene, const CameraPose& camera, DebugView which)
{
    RenderSettings settings;
    settings.view = which;
    RenderRequest request = linear_request(scene, kGbufferExtent, settings);
    request.camera = camera;
    return view.render(request).image;
}

struct Move {
    const char* name;
    glm::dvec3 position;
    glm::dvec3 target;
    double fov;

    friend void PrintTo(const Move& move, std::ostream* out) { *out << move.name; }
};

class MotionTest : public GlTest, public testing::WithParamInterface<Move> { };

TEST_P(MotionTest, EqualsADoublePrecisionReprojection)
{
    Scene scene = shipped_scene("cornell_box.json");
    const DeviceScene on_device(scene);
    CameraPose before = scene.camera;
    CameraPose now = before;
    now.position += GetParam().position;
    now.target += GetParam().target;
    now.vertical_fov_degrees += GetParam().fov;
    View positions(on_device.shared);
    const Image position = view_of(positions, scene, now, DebugView::kPosition);
    View moving(on_device.shared);
    view_of(moving, scene, before, DebugView::kMotion);
    const Image motion = view_of(moving, scene, now, DebugView::kMotion);

    int met = 0;
    for (int y = 0; y < kGbufferExtent.height; ++y)
        for (int x = 0; x < kGbufferExtent.width; ++x) {
            const glm::dvec3 p = pixel(position, x, y);
            if (p == glm::dvec3(0))
                continue;
            ++met;
            const glm::dvec3 expected =
                project(before, p, kGbufferExtent) - project(now, p, kGbufferExtent);
            ASSERT_NEAR(pixel(motion, x, y).x, expected.x, 1e-3) << x << "," << y;
            ASSERT_NEAR(pixel(motion, x, y).y, expected.y, 1e-3) << x << "," << y;
            ASSERT_NEAR(pixel(motion, x, y).z, expected.z, 1e-5 * scene_bounds(scene).radius())
                << x << "," << y;
        }
    EXPECT_GT(met, kGbufferExtent.width * kGbufferExtent.height / 4);
}

INSTANTIATE_TEST_SUITE_P(Moves, MotionTest,
    testing::Values(Move{"Rest", {0, 0, 0}, {0, 0, 0}, 0}, Move{"Pan", {30, 5, 0}, {30, 5, 0}, 0},
        Move{"Turn", {0, 0, 0}, {120, -40, 0}, 0}, Move{"Dolly", {0, 0, 200}, {0, 0, 200}, 0},
        Move{"Orbit", {60, 20, 10}, {0, 0, 0}, 0}, Move{"Zoom", {0, 0, 0}, {0, 0, 0}, 8}),
    [](const auto& test) { return test.param.name; });

TEST_F(GlTest, RestingCameraHasExactlyNoMotion)
{
    Scene scene = shipped_scene("four_spheres.json");
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    view_of(view, scene, scene.camera, DebugView::kMotion);
    const Image motion = view_of(view, scene, scene.camera, DebugView::kMotion);
    for (int y = 0; y < kGbufferExtent.height; ++y)
        for (int x = 0; x < kGbufferExtent.width; ++x)
            ASSERT_EQ(pixel(motion, x, y), glm::vec3(0)) << x << "," << y;
}

/// The depth gradient predicts the neighbour's depth exactly where both see one plane.
TEST_F(GlTest, DepthGradientIsThePlanesOwn)
{
    Scene scene;
    scene.materials.push_back({"white"});
    scene.objects.push_back({"plane", 0, Quad{{-100, -1, -100}, {0, 0, 200}, {200, 0, 0}}});
    scene.camera = {{0, 1, 0}, {0.3, 0, -2}, {0, 1, 0}, 40};
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    const Image depth = view_of(view, scene, scene.camera, DebugView::kDepth);
    const Image gradient = view_of(view, scene, scene.camera, DebugView::kDepthGradient);
    for (int y = 1; y + 1 < kGbufferExtent.height; ++y)
        for (int x = 1; x + 1 < kGbufferExtent.width; ++x) {
            const glm::vec3 g = pixel(gradient, x, y);
            // Depth is z(p) = c / (a . p + b) on a plane: its reciprocal is linear, so central
            // differences of 1/z are exact, and dz = -z^2 d(1/z).
            const double z = pixel(depth, x, y).x;
            const double dx = (1 / pixel(depth, x + 1, y).x - 1 / pixel(depth, x - 1, y).x) / 2.0;
            const double dy = (1 / pixel(depth, x, y + 1).x - 1 / pixel(depth, x, y - 1).x) / 2.0;
            ASSERT_NEAR(g.x, -z * z * dx, 2e-5 * z) << x << "," << y;
            ASSERT_NEAR(g.y, -z * z * dy, 2e-5 * z) << x << "," << y;
        }
}

}  // namespace
}  // namespace farlight
