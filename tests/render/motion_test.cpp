// Moving things on the device: an instance is what the same thing is flattened, it is not met again
// by rays that leave it, and poses depend on time alone.
#include "lab/meshes.h"
#include "tests/support/gl_test.h"
#include "tests/support/moving_scenes.h"

#include <glm/gtc/matrix_transform.hpp>

namespace farlight {
namespace {

constexpr Extent kMotionExtent{97, 61};

Image view_of(View& view, const Scene& scene, DebugView which, double time)
{
    RenderSettings settings;
    settings.view = which;
    RenderRequest request = linear_request(scene, kMotionExtent, settings);
    request.time = time;
    return view.render(request).image;
}

/// A mesh twice, one of each other shape, all placed askew; the second mesh and the sphere are
/// mirrored, the disk and the second mesh squeezed.
Scene things_of_all_kinds()
{
    Mesh mesh = bumpy_sphere(40, 20);
    mesh.normals = mesh.positions;
    for (glm::vec3& n : mesh.normals)
        n = glm::normalize(n);
    Scene scene = scene_of(std::move(mesh));
    scene.materials[0].albedo = glm::vec3(1);
    scene.objects.push_back({"second", 0, MeshInstance{}});
    scene.objects.push_back({"ball", 0, Sphere{{0.2, 0.1, 0}, 0.7}});
    scene.objects.push_back({"plate", 0, Quad{{-0.7, -0.5, 0}, {1.3, 0.1, 0}, {0, 1, 0.2}}});
    scene.objects.push_back(
        {"coin", 0, Disk{{0, 0, 0.1}, glm::normalize(glm::dvec3(1, 2, 4)), 0.7}});
    scene.background = glm::vec3(1);
    scene.camera = {{1, 2, 9}, {0, 0, 0}, {0, 1, 0}, 45};
    return scene;
}

glm::dmat4 placed(std::size_t i, double scale, const glm::dvec3& at)
{
    static const glm::dvec3 kWhere[] = {
        {-2.4, 0.3, 0}, {0, 1.3, -1}, {2.2, 0.4, 0}, {-0.8, -1.6, 1}, {1.3, -1.5, 0.5}};
    static const glm::dvec3 kScale[] = {
        {0.8, 0.8, 0.8}, {-1.2, 0.7, 0.9}, {-1, 1, 1}, {1, 1.3, 0.8}, {1.2, 0.6, 1}};
    glm::dmat4 m = glm::translate(glm::dmat4(1), scale * (kWhere[i] + at));
    m = glm::rotate(m, 0.7 + 0.4 * static_cast<double>(i), glm::normalize(glm::dvec3(1, 2, 0.5)));
    return glm::scale(m, scale * kScale[i]);
}

struct Placement {
    const char* name;
    double scale;
    glm::dvec3 at;  ///< In units of the scale.

    friend void PrintTo(const Placement& placement, std::ostream* out) { *out << placement.name; }
};

class InstanceTest : public GlTest, public testing::WithParamInterface<Placement> {
protected:
    static Scene scene(bool moving)
    {
        const auto& [name, scale, at] = GetParam();
        Scene scene = things_of_all_kinds();
        hang_on_nodes(
            scene, [&](std::size_t i) { return placed(i, scale, at); }, moving);
        scene.camera.position = scale * (scene.camera.position + at);
        scene.camera.target = scale * (scene.camera.target + at);
        return scene;
    }
};

/// At time 1 what moved stands where the same thing at rest does.
TEST_P(InstanceTest, LooksLikeTheSameThingAtRest)
{
    const DeviceScene resting(scene(false));
    const DeviceScene moving(scene(true));
    ASSERT_TRUE(moving.inputs.calls_for("FX_INSTANCES"));
    const double size =
        scene_bounds(resting.scene).radius() + glm::length(GetParam().at * GetParam().scale);
    for (const DebugView which :
        {DebugView::kPosition, DebugView::kShadingNormal, DebugView::kObjectId}) {
        View rest_view(resting.shared);
        View moving_view(moving.shared);
        const Image a = view_of(rest_view, resting.scene, which, 0);
        const Image b = view_of(moving_view, moving.scene, which, 1);
        // An instance's normals are interpolated before they are transformed: squeezed, another
        // curve between the same corners.
        const double tolerance = which == DebugView::kPosition ? 1e-6 * size
            : which == DebugView::kObjectId                    ? 0
                                                               : 0.02;
        int different = 0;
        for (int y = 0; y < kMotionExtent.height; ++y)
            for (int x = 0; x < kMotionExtent.width; ++x)
                different += glm::distance(pixel(a, x, y), pixel(b, x, y)) <= tolerance ? 0 : 1;
        // An outline may fall on either side of a pixel's middle.
        EXPECT_LE(different, 5) << static_cast<int>(which);
    }
}

/// White things under a white sky vanish: a pixel is below 1 only where a ray was caught on the
/// surface it left.
TEST_P(InstanceTest, IsNotMetAgainByRaysThatLeaveIt)
{
    const DeviceScene on_device(scene(true));
    RenderSettings s;
    s.denoiser = Denoiser::kOff;
    s.max_depth = 64;
    s.roulette_depth = 64;
    s.samples_per_pixel = 4;
    View view(on_device.shared);
    RenderRequest request = linear_request(on_device.scene, kMotionExtent, s);
    request.time = 1;
    const Image image = view.render(request).image;
    for (int y = 0; y < kMotionExtent.height; ++y)
        for (int x = 0; x < kMotionExtent.width; ++x)
            ASSERT_NEAR(pixel(image, x, y).x, 1, 1e-4) << x << "," << y;
}

INSTANTIATE_TEST_SUITE_P(ScalesAndPlaces, InstanceTest,
    testing::Values(Placement{"AtTheOrigin", 1, {0, 0, 0}}, Placement{"Tiny", 1e-3, {0, 1.5, 4}},
        Placement{"Huge", 1e4, {0, 0, 0}}, Placement{"FarAway", 1, {1e3, 500, -250}}),
    [](const auto& test) { return test.param.name; });

TEST_F(GlTest, AfterTheLastKeyTimeGoesOnButThePictureRests)
{
    Scene scene = things_of_all_kinds();
    hang_on_nodes(
        scene, [](std::size_t i) { return placed(i, 1, {}); }, true);
    const Course course = course_of(scene.animation);
    ASSERT_FALSE(course.any_repeats);
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderRequest request = linear_request(on_device.scene, {32, 24}, RenderSettings{});
    request.settings.denoiser = Denoiser::kAccumulate;
    std::vector<std::uint32_t> samples;
    for (const double after : {-0.1, 0.1, 0.2, 0.3}) {
        request.time = course.duration + after;
        const RenderedFrame frame = view.render(request);
        EXPECT_EQ(frame.moves, after < 0) << after;
        EXPECT_EQ(frame.time, course.duration + std::min(after, 0.0));
        samples.push_back(frame.accumulated_samples);
    }
    EXPECT_EQ(samples, (std::vector<std::uint32_t>{1, 1, 2, 3}));
}

/// While time stands still, what could move has exactly no motion, and pictures may be averaged;
/// nor has what never moves in a space of its own, as a disc that its carrier squeezes.
TEST_F(GlTest, PausedThingsHaveExactlyNoMotion)
{
    Scene things = things_of_all_kinds();
    hang_on_nodes(
        things, [](std::size_t i) { return placed(i, 1, {}); }, true);
    Scene resting = things_of_all_kinds();
    hang_on_nodes(
        resting, [](std::size_t i) { return placed(i, 1, {}); }, false);
    for (Scene source : {bending_bar(12, 8), swelling_sphere(12, 8), things, resting}) {
        const DeviceScene on_device(std::move(source));
        ASSERT_TRUE(on_device.inputs.calls_for("FX_INSTANCES")
            || on_device.inputs.calls_for("FX_DEFORMATION"));
        View view(on_device.shared);
        view_of(view, on_device.scene, DebugView::kMotion, 0.4);
        const Image motion = view_of(view, on_device.scene, DebugView::kMotion, 0.4);
        for (int y = 0; y < kMotionExtent.height; ++y)
            for (int x = 0; x < kMotionExtent.width; ++x)
                ASSERT_EQ(pixel(motion, x, y), glm::vec3(0)) << x << "," << y;
    }
}

/// What it takes to pose the scene is told, as a pass, in frames that did.
TEST_F(GlTest, PosingIsTimedWhereSomethingHasMoved)
{
    const DeviceScene on_device(bending_bar(12, 8));
    View view(on_device.shared);
    RenderRequest request = linear_request(on_device.scene, {8, 8}, {});
    const auto poses = [&](double time) {
        request.time = time;
        const RenderedFrame frame = view.render(request);
        double sum = 0;
        for (const PassTime& pass : frame.pass_times)
            if (pass.pass == "pose" || pass.pass == "gbuffer" || pass.pass == "path_trace")
                sum += pass.milliseconds;
        EXPECT_DOUBLE_EQ(frame.trace_ms, sum);
        return frame.pass_times.front().pass == "pose";
    };
    EXPECT_TRUE(poses(0.3));
    EXPECT_FALSE(poses(0.3));
    EXPECT_TRUE(poses(0.4));
}

/// A frame depends on its time and the last frame's, not on what was drawn before.
TEST_F(GlTest, PosesDependOnTimeAlone)
{
    const DeviceScene on_device(bending_bar(12, 8));
    View first(on_device.shared);
    const Image fresh = view_of(first, on_device.scene, DebugView::kPosition, 0.5);
    View second(on_device.shared);
    for (const double time : {3.0, 0.0, 0.9})
        view_of(second, on_device.scene, DebugView::kPosition, time);
    const Image again = view_of(second, on_device.scene, DebugView::kPosition, 0.5);
    EXPECT_EQ(fresh.bytes, again.bytes);
}

}  // namespace
}  // namespace farlight
