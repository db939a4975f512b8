// Fog through the whole renderer, against closed forms and quadrature.
//
// Statistical tests use fixed seeds, so they are deterministic; the bounds are 5 standard errors,
// which a fresh seed would exceed by chance once in 1.7 million.
#include "lab/statistics.h"
#include "server/render/camera.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

constexpr double kPi = 3.14159265358979;
constexpr Extent kFogExtent{32, 24};

/// A black ball far below the view gives the scene its size, and so the fog its own.
Scene foggy(const Medium& medium, double size)
{
    Scene scene;
    scene.materials.push_back({"black", glm::vec3(0)});
    scene.objects.push_back({"ball", 0, Sphere{{0, 0, 0}, size}});
    scene.medium = medium;
    return scene;
}

RenderSettings settings_of(int max_depth, int samples)
{
    RenderSettings s;
    s.denoiser = Denoiser::kAccumulate;
    s.antialiasing = false;
    s.max_depth = max_depth;
    s.roulette_depth = 64;
    s.samples_per_pixel = samples;
    return s;
}

Image mean_picture(const DeviceScene& scene, const RenderSettings& settings, int frames)
{
    View view(scene.shared);
    const RenderRequest request = linear_request(scene.scene, kFogExtent, settings);
    RenderedFrame frame;
    for (int i = 0; i < frames; ++i)
        frame = view.render(request);
    EXPECT_EQ(frame.bad_values.all(), 0U);
    return std::move(frame.image);
}

/// What shines behind a thickness of ink is dimmed by it, each channel for itself, and nothing of
/// that is left to chance.
TEST_F(GlTest, AbsorbingFogFollowsBeerAndLambert)
{
    Scene scene;
    scene.materials.push_back({"light", glm::vec3(0), glm::vec3(1)});
    scene.objects.push_back({"wall", 0, Quad{{-4, -4, 0}, {8, 0, 0}, {0, 8, 0}}});
    scene.medium.sigma_a = {0.1F, 0.4F, 2};
    scene.camera = {{0.2, -0.1, 3}, {0, 0, 0}, {0, 1, 0}, 50};
    const DeviceScene on_device(scene);
    const Image image = mean_picture(on_device, settings_of(4, 1), 1);
    const shared::CameraConstants camera = camera_constants(scene.camera, kFogExtent);
    for (int y = 0; y < kFogExtent.height; ++y)
        for (int x = 0; x < kFogExtent.width; ++x) {
            const double u = (x + 0.5) / kFogExtent.width * 2 - 1;
            const double v = (y + 0.5) / kFogExtent.height * 2 - 1;
            const glm::dvec3 way = glm::dvec3(camera.forward) + u * glm::dvec3(camera.right)
                - v * glm::dvec3(camera.up);
            const double distance = glm::length(way) * 3 / -way.z;
            for (int c = 0; c < 3; ++c) {
                const double expected = std::exp(-scene.medium.sigma_a[c] * distance);
                ASSERT_NEAR(pixel(image, x, y)[c], expected, 1e-5) << x << "," << y;
            }
        }
}

double henyey_greenstein(double cosine, double g)
{
    return (1 - g * g) / (4 * kPi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

struct Glow {
    const char* name;
    float g;
    float sigma_a;
    float sigma_s;

    friend void PrintTo(const Glow& glow, std::ostream* out) { *out << glow.name; }
};

class GlowTest : public GlTest, public testing::WithParamInterface<Glow> { };

/// A point light beside the line of sight, light scattered once, against the integral along the
/// ray: sigma_s exp(-sigma_t (t + r)) p(cos) I / r^2.
TEST_P(GlowTest, PointLightInFogEqualsQuadrature)
{
    const auto& [name, g, sigma_a, sigma_s] = GetParam();
    Scene scene = foggy({"fog", glm::vec3(sigma_a), glm::vec3(sigma_s), g}, 1);
    PunctualLight lamp;
    lamp.intensity = glm::vec3(5);
    lamp.position = {0, 2.5, 0};
    scene.lights.push_back(lamp);
    // A narrow view along +x, past the ball, through a sphere of fog about the origin: four radii
    // of the box around the ball.
    const double radius = 4 * std::sqrt(3.0);
    scene.camera = {{-2, 1.6, 0}, {2, 1.6, 0}, {0, 1, 0}, 0.5};
    const DeviceScene on_device(scene);
    const Estimate estimate = mean_of(mean_picture(on_device, settings_of(2, 256), 2));

    double expected = 0;
    const double end = 2 + std::sqrt(radius * radius - 1.6 * 1.6);
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps * end;
        const glm::dvec3 at(-2 + t, 1.6, 0);
        const glm::dvec3 to_lamp = lamp.position - at;
        const double r = glm::length(to_lamp);
        // The light goes from the lamp to `at` and then back along the ray.
        const double cosine = glm::dot(-to_lamp / r, glm::dvec3(-1, 0, 0));
        expected += sigma_s * std::exp(-(static_cast<double>(sigma_a) + sigma_s) * (t + r))
            * henyey_greenstein(cosine, g) * 5 / (r * r) * end / kSteps;
    }
    // 1e-3: the glow changes by about that much over the half degree that is seen.
    EXPECT_NEAR(estimate.mean, expected, 5 * estimate.standard_error + 1e-3 * expected);
    EXPECT_LT(estimate.standard_error, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(Fogs, GlowTest,
    testing::Values(Glow{"Isotropic", 0, 0, 0.3F}, Glow{"Absorbing", 0, 0.5F, 0.3F},
        Glow{"Forward", 0.7F, 0.1F, 0.4F}, Glow{"Backward", -0.6F, 0, 0.5F},
        Glow{"Dense", 0.2F, 0, 3}),
    [](const auto& test) { return test.param.name; });

/// Chance and light sampling find the same light in the fog, on surfaces and in between.
TEST_F(GlTest, InFogLightSamplingAgreesWithChanceHits)
{
    Scene scene = foggy({"fog", glm::vec3(0.02F), glm::vec3(0.3F, 0.2F, 0.1F), 0.4F}, 1);
    scene.materials[0].albedo = glm::vec3(0.6F);
    scene.materials.push_back({"light", glm::vec3(0), glm::vec3(2), true});
    scene.objects.push_back({"lamp", 1, Quad{{-1, 1.5, -1}, {2, 0, 0}, {0, 0, 2}}});
    scene.camera = {{0, 1, 4}, {0, 0.5, 0}, {0, 1, 0}, 50};
    const DeviceScene on_device(scene);
    Image images[2];
    for (const bool light_sampling : {false, true}) {
        RenderSettings s = settings_of(5, 256);
        s.light_sampling = light_sampling;
        images[light_sampling] = mean_picture(on_device, s, 2);
    }
    // The error of the difference: what both pictures show is no noise.
    const Estimate difference = mean_of(difference_of(images[0], images[1]));
    EXPECT_NEAR(difference.mean, 0, 5 * difference.standard_error);
    EXPECT_LT(difference.standard_error, 0.005 * mean_of(images[1]).mean);
}

/// Fog's light is filtered on sky and surfaces alike, and only among pixels behind much the same
/// amount of fog: with a white sky nothing of that shows.
TEST_F(GlTest, FilterKeepsFogWhereItIs)
{
    Scene scene = foggy({"fog", glm::vec3(0), glm::vec3(0.2F), 0}, 1);
    scene.materials[0].albedo = glm::vec3(1);
    scene.background = glm::vec3(1);
    scene.camera = {{0, 1, 3.2}, {0, 0, 0}, {0, 1, 0}, 45};
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderSettings s = settings_of(64, 1);
    s.denoiser = Denoiser::kSvgf;
    const RenderRequest request = linear_request(scene, kFogExtent, s);
    for (int frame = 0; frame < 4; ++frame) {
        const RenderedFrame drawn = view.render(request);
        ASSERT_EQ(drawn.bad_values.all(), 0U);
        for (int y = 0; y < kFogExtent.height; ++y)
            for (int x = 0; x < kFogExtent.width; ++x)
                // 0.05: the opacities that the filter lets through, which here are the light itself
                ASSERT_NEAR(pixel(drawn.image, x, y).x, 1, 0.05) << x << "," << y;
    }
}

}  // namespace
}  // namespace farlight
