// Scenes whose light is known in closed form, against the path tracer.
//
// Statistical tests use fixed seeds, so they are deterministic; the bounds are 5 standard errors,
// which a fresh seed would exceed by chance once in 1.7 million.
#include "lab/statistics.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

/// The accumulated mean of `frames` frames of `settings`.
Image accumulate(const DeviceScene& scene, RenderRequest request, int frames)
{
    request.settings.denoiser = Denoiser::kAccumulate;
    View view(scene.shared);
    RenderedFrame frame;
    for (int i = 0; i < frames; ++i)
        frame = view.render(request);
    EXPECT_EQ(frame.bad_values.all(), 0U);
    return std::move(frame.image);
}

// A lamp two units above a floor: light sampling and chance must agree however large the floor is
// and wherever it stands, although the floor's rays start off it by an error that grows with its
// coordinates.
struct LampCase {
    const char* name;
    double half_extent;
    double away;
    bool sphere;

    friend void PrintTo(const LampCase& c, std::ostream* out) { *out << c.name; }
};

class LampTest : public GlTest, public testing::WithParamInterface<LampCase> { };

TEST_P(LampTest, LightSamplingAgreesWithChanceHits)
{
    const auto& [name, half, away, sphere] = GetParam();
    const glm::dvec3 at(away, 0, -away);
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)}, {"light", glm::vec3(0), glm::vec3(1)}};
    scene.objects.push_back(
        {"floor", 0, Quad{at + glm::dvec3(-half, 0, -half), {0, 0, 2 * half}, {2 * half, 0, 0}}});
    if (sphere)
        scene.objects.push_back({"light", 1, Sphere{at + glm::dvec3(0, 2, 0), 0.5}});
    else
        scene.objects.push_back(
            {"light", 1, Quad{at + glm::dvec3(-0.5, 2, -0.5), {1, 0, 0}, {0, 0, 1}}});
    scene.camera = {at + glm::dvec3(1.5, 1, 1.5), at, {0, 1, 0}, 30};
    const DeviceScene on_device(scene);
    Estimate estimates[2];
    for (const bool light_sampling : {false, true}) {
        RenderSettings s;
        s.max_depth = 2;
        s.samples_per_pixel = 256;
        s.light_sampling = light_sampling;
        estimates[light_sampling] =
            mean_of(accumulate(on_device, linear_request(scene, {32, 32}, s), 2));
    }
    const double error = std::hypot(estimates[0].standard_error, estimates[1].standard_error);
    EXPECT_NEAR(estimates[1].mean, estimates[0].mean, 5 * error);
    EXPECT_GT(estimates[1].mean, 0.01);
}

INSTANTIATE_TEST_SUITE_P(AnalyticScenes, LampTest,
    testing::Values(LampCase{"SmallFloor", 3, 0, false}, LampCase{"LargeFloor", 1e3, 0, false},
        LampCase{"HugeFloor", 1e4, 0, false}, LampCase{"FarAway", 3, 1e3, false},
        LampCase{"VeryFarAway", 3, 1e4, false}, LampCase{"SphereOverHugeFloor", 1e4, 0, true},
        LampCase{"SphereFarAway", 3, 1e4, true}),
    [](const auto& test) { return test.param.name; });

/// An emitter shows its radiance to its front only, unless it emits on both sides.
TEST_F(GlTest, QuadEmitsOnTheSideItsNormalPointsTo)
{
    for (const bool both : {false, true})
        for (const bool front : {false, true}) {
            Scene scene;
            scene.materials.push_back({"light", glm::vec3(0), glm::vec3(3, 2, 1), both});
            scene.objects.push_back(
                {"light", 0, Quad{{-5, -5, 0}, {10, 0, 0}, {0, 10, 0}}});  // normal +z
            scene.camera.position = {0, 0, front ? 2 : -2};
            scene.camera.target = {0, 0, 0};
            const DeviceScene on_device(scene);
            View view(on_device.shared);
            const RenderedFrame frame = view.render(linear_request(on_device.scene, {8, 8}, {}));
            EXPECT_EQ(pixel(frame.image, 4, 4), front || both ? glm::vec3(3, 2, 1) : glm::vec3(0));
        }
}

}  // namespace
}  // namespace farlight
