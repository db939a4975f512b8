// The G-buffer against a double-precision camera on the CPU: motion, depth and its gradient.
#include "lab/meshes.h"
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

/// White surfaces under a white sky vanish: a pixel is below 1 only where a ray was caught on the
/// surface it left, or slipped inside it and stayed there.
Scene white_things(double scale, const glm::dvec3& center)
{
    Scene scene = scene_of(bumpy_sphere(60, 30));
    scene.materials[0].albedo = glm::vec3(1);
    scene.background = glm::vec3(1);
    const auto place = [&](const glm::dvec3& at) { return center + scale * at; };
    glm::dmat4 world_from_object(scale);
    world_from_object[3] = glm::dvec4(place({-1.3, 0, 0}), 1);
    std::get<MeshInstance>(scene.objects[0].shape).world_from_object = world_from_object;
    scene.objects.push_back({"ball", 0, Sphere{place({1.3, 0, 0}), scale}});
    // One plate along the axes with coordinates that are exactly zero, one askew.
    scene.objects.push_back({"plate", 0,
        Quad{place({-4, -1.5, -4}), scale * glm::dvec3(0, 0, 8), scale * glm::dvec3(8, 0, 0)}});
    scene.objects.push_back({"askew", 0,
        Quad{
            place({-3, -1, -3}), scale * glm::dvec3(5, 1, 0.3), scale * glm::dvec3(-0.2, 3, 0.7)}});
    scene.camera = {place({0, 1.5, 5}), center, {0, 1, 0}, 40};
    return scene;
}

struct Placement {
    const char* name;
    double scale;
    glm::dvec3 at;  ///< In units of the scale.

    friend void PrintTo(const Placement& placement, std::ostream* out) { *out << placement.name; }
};

class SelfIntersectionTest : public GlTest, public testing::WithParamInterface<Placement> { };

TEST_P(SelfIntersectionTest, WhiteThingsUnderAWhiteSkyVanish)
{
    const auto& [name, scale, at] = GetParam();
    const DeviceScene on_device(white_things(scale, scale * at));
    RenderSettings s;
    s.denoiser = Denoiser::kOff;
    s.max_depth = 64;  // a path that has not escaped by then was caught
    s.roulette_depth = 64;
    s.samples_per_pixel = 8;
    View view(on_device.shared);
    const Image image = view.render(linear_request(on_device.scene, kGbufferExtent, s)).image;
    for (int y = 0; y < kGbufferExtent.height; ++y)
        for (int x = 0; x < kGbufferExtent.width; ++x)
            ASSERT_NEAR(pixel(image, x, y).x, 1, 1e-4) << x << "," << y;
}

INSTANTIATE_TEST_SUITE_P(ScalesAndPlaces, SelfIntersectionTest,
    testing::Values(Placement{"AtTheOrigin", 1, {0, 0, 0}},
        Placement{"PlateAtExactlyZero", 1, {0, 1.5, 0}}, Placement{"Tiny", 1e-3, {0, 1.5, 4}},
        Placement{"Huge", 1e4, {0, 0, 0}}, Placement{"FarAway", 1, {1e3, 500, -250}},
        Placement{"LargeAndFarAway", 1e3, {1e3, 500, -250}}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
