// Irradiance of lights in closed form, against the path tracer; and what must not change it.
//
// Statistical tests use fixed seeds, so they are deterministic; the bounds are 5 standard errors,
// which a fresh seed would exceed by chance once in 1.7 million.
#include "lab/statistics.h"
#include "server/scene/packed_scene.h"
#include "tests/support/gl_test.h"

#include <functional>
#include <numbers>

namespace farlight {
namespace {

using std::numbers::pi;

Estimate mean_radiance(const DeviceScene& scene, const RenderSettings& settings, int frames)
{
    RenderRequest request = linear_request(scene.scene, {32, 32}, settings);
    request.settings.denoiser = Denoiser::kAccumulate;
    View view(scene.shared);
    RenderedFrame frame;
    for (int i = 0; i < frames; ++i)
        frame = view.render(request);
    EXPECT_EQ(frame.bad_values.all(), 0U);
    return mean_of(frame.image);
}

constexpr double kHalfWidth = 1e-3;  // of the plane [m]

/// A small plane of albedo 0.5 at the origin facing +y, seen from the side at one point. Its
/// radiance is albedo / pi * E; the camera sees a piece so small that E is the same all over it.
Scene plane_under(const std::function<void(Scene&)>& add_lights)
{
    Scene scene;
    scene.materials = {{"plane", glm::vec3(0.5F)}, {"light", glm::vec3(0), glm::vec3(1)}};
    scene.objects.push_back({"plane", 0,
        Quad{{-kHalfWidth, 0, -kHalfWidth}, {0, 0, 2 * kHalfWidth}, {2 * kHalfWidth, 0, 0}}});
    scene.camera.position = {0.02, 0.02, -0.02};
    scene.camera.target = {0, 0, 0};
    scene.camera.vertical_fov_degrees = 0.5;
    add_lights(scene);
    return scene;
}

void place_light(Scene& scene, const std::variant<Sphere, Quad, MeshInstance, Disk>& shape)
{
    scene.objects.push_back({"light", 1, shape});
}

/// Light that the plane reflects, to 5 standard errors and `tolerance` times it.
void expect_mean(
    const DeviceScene& scene, double expected, double tolerance, int samples, bool light_sampling)
{
    RenderSettings s;
    s.max_depth = 2;
    s.light_sampling = light_sampling;
    s.samples_per_pixel = samples;
    const Estimate estimate = mean_radiance(scene, s, 8);
    EXPECT_NEAR(estimate.mean, expected, 5 * estimate.standard_error + tolerance * expected)
        << (light_sampling ? "with" : "without") << " light sampling";
}

/// Lights over the plane; those with an extent have radiance 1.
struct IrradianceCase {
    const char* name;
    double expected;  ///< E [W/m^2].
    std::function<void(Scene&)> add_lights;
    bool chance_finds_it = true;  ///< It has an extent that a BSDF sample may hit.
    int samples = 64;

    friend void PrintTo(const IrradianceCase& c, std::ostream* out) { *out << c.name; }
};

class IrradianceTest : public GlTest, public testing::WithParamInterface<IrradianceCase> { };

TEST_P(IrradianceTest, LightAndBsdfSamplingGiveTheClosedForm)
{
    const DeviceScene scene(plane_under(GetParam().add_lights));
    const double expected = 0.5 / pi * GetParam().expected;
    // 2e-4: E changes by about that much over the piece of plane that is seen.
    expect_mean(scene, expected, 2e-4, GetParam().samples, true);
    if (GetParam().chance_finds_it)
        expect_mean(scene, expected, 2e-4, GetParam().samples, false);
}

std::function<void(Scene&)> shape(const std::variant<Sphere, Quad, MeshInstance, Disk>& shape)
{
    return [=](Scene& scene) { place_light(scene, shape); };
}

Quad unit_quad_above(double height, const glm::dvec3& offset)
{
    return {glm::dvec3(-0.5, height, -0.5) + offset, {1, 0, 0},
        {0, 0, 1}};  // faces down: x cross z = -y
}

Sphere sphere_at_angle(double distance, double radius, double angle)
{
    return {distance * glm::dvec3(std::sin(angle), std::cos(angle), 0), radius};
}

/// The quad above its middle, in n x n parts.
std::function<void(Scene&)> split_quad(int n)
{
    return [=](Scene& scene) {
        const double side = 1.0 / n;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                place_light(
                    scene, Quad{{-0.5 + i * side, 1, -0.5 + j * side}, {side, 0, 0}, {0, 0, side}});
    };
}

/// The same as a mesh of 2 n^2 triangles.
std::function<void(Scene&)> quad_mesh(unsigned n)
{
    return [=](Scene& scene) {
        Mesh mesh{"grid", {}, {}, {}};
        for (unsigned i = 0; i <= n; ++i)
            for (unsigned j = 0; j <= n; ++j)
                mesh.positions.emplace_back(static_cast<float>(i) / static_cast<float>(n) - 0.5F, 1,
                    static_cast<float>(j) / static_cast<float>(n) - 0.5F);
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < n; ++j) {
                const unsigned at = i * (n + 1) + j;
                mesh.triangles.emplace_back(at, at + n + 1, at + n + 2);
                mesh.triangles.emplace_back(at, at + n + 2, at + 1);
            }
        scene.meshes.push_back(mesh);
        place_light(scene, MeshInstance{});
    };
}

/// The triangle (1, .2, 2), (-.5, 1, 1.5), (-.7, -.9, 2.5) over a plane whose normal is z, turned
/// so that it is y, facing down.
void place_triangle(Scene& scene)
{
    scene.meshes.push_back(
        {"triangle", {{1, 2, .2}, {-.5, 1.5, 1}, {-.7, 2.5, -.9}}, {}, {{0, 1, 2}}});
    scene.materials[1].emits_both_sides = true;
    place_light(scene, MeshInstance{});
}

std::function<void(Scene&)> punctual(const PunctualLight& light)
{
    return [=](Scene& scene) { scene.lights.push_back(light); };
}

/// A spot 2 m away, 0.5 rad off the normal, whose axis passes the plane at `angle`.
PunctualLight spot(double angle)
{
    return {.name = "spot",
        .kind = PunctualLight::Kind::kSpot,
        .intensity = glm::vec3(3),
        .position = 2.0 * glm::dvec3(std::sin(0.5), std::cos(0.5), 0),
        .direction = -glm::dvec3(std::sin(0.5 + angle), std::cos(0.5 + angle), 0),
        .inner_cone = 0.2,
        .outer_cone = 0.6};
}

double spot_irradiance(double angle)
{
    const double x = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
    const double falloff = std::clamp(x, 0.0, 1.0);
    return 3 * falloff * falloff * std::cos(0.5) / 4;
}

const std::vector<IrradianceCase>& irradiance_cases()
{
    static const std::vector<IrradianceCase> cases{
        // Lambert 1760, E = 1/2 |sum theta_i (n . Gamma_i)|.
        {"QuadAboveItsMiddle", 0.75227469, shape(unit_quad_above(1, {0, 0, 0}))},
        {"QuadAboveItsCorner", 0.43520988, shape(unit_quad_above(1, {0.5, 0, 0.5}))},
        {"QuadInNineParts", 0.75227469, split_quad(3)},
        {"QuadOfTwoTriangles", 0.75227469, quad_mesh(1)},
        {"QuadOf128Triangles", 0.75227469, quad_mesh(8)},
        {"Triangle", 0.34712344, place_triangle},
        {"Disk", pi / 5, shape(Disk{{0, 2, 0}, {0, -1, 0}, 1})},  // pi r^2 / (r^2 + h^2)
        // pi (r/d)^2 cos(theta) clear of the horizon; cut by it: Snyder's closed form, recomputed
        // by quadrature.
        {"SphereOverhead", 0.785398, shape(sphere_at_angle(2, 1, 0))},
        {"SphereAside", 0.162054, shape(sphere_at_angle(2, 0.5, 0.6))},
        {"SphereCutByTheHorizon", 0.289484, shape(sphere_at_angle(2, 1, 1.2))},
        {"SphereCutInHalf", 0.120531, shape(sphere_at_angle(2, 1, 1.5)), true, 128},
        {"SphereMostlyBelow", 0.008259, shape(sphere_at_angle(3, 1, 1.7)), true, 256},
        {"SphereVeryNear", 1.257843, shape(sphere_at_angle(1.2, 1, 1.0))},
        {"SphereVeryNearAndLow", 0.300676, shape(sphere_at_angle(1.2, 1, 1.8)), true, 128},
        // Intensity over distance squared, times the cosine.
        {"Point", 3 * std::cos(0.5) / 4,
            punctual({.intensity = glm::vec3(3), .position = sphere_at_angle(2, 1, 0.5).center}),
            false, 1},
        {"PointBelow", 0, punctual({.position = {0, -1, 0}}), false, 1},
        {"SpotInItsInnerCone", spot_irradiance(0.1), punctual(spot(0.1)), false, 1},
        {"SpotInItsPenumbra", spot_irradiance(0.4), punctual(spot(0.4)), false, 1},
        {"SpotBesideItsCone", 0, punctual(spot(0.7)), false, 1},
        {"Directional", 2 * std::cos(0.7),
            punctual({.kind = PunctualLight::Kind::kDirectional,
                .intensity = glm::vec3(2),
                .direction = -sphere_at_angle(1, 1, 0.7).center}),
            false, 1},
    };
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Lights, IrradianceTest, testing::ValuesIn(irradiance_cases()),
    [](const auto& test) { return test.param.name; });

/// Left half white and there, right half black or not there.
Image8 half(const glm::u8vec4& left, const glm::u8vec4& right)
{
    Image8 image{"half", 256, 1, {}};
    image.texels.resize(256, right);
    std::fill_n(image.texels.begin(), 128, left);
    return image;
}

/// What a texture or opacity makes of the unit quad above its corner, of which u grows with x.
struct PatternCase {
    const char* name;
    double expected;  ///< E [W/m^2].
    std::function<void(Scene&)> dress;  ///< Changes materials[1].

    friend void PrintTo(const PatternCase& c, std::ostream* out) { *out << c.name; }
};

class PatternTest : public GlTest, public testing::WithParamInterface<PatternCase> { };

TEST_P(PatternTest, LightAndBsdfSamplingAgreeOnAQuadAndOnAMesh)
{
    for (const bool mesh : {false, true}) {
        const DeviceScene scene(plane_under([&](Scene& s) {
            GetParam().dress(s);
            if (!mesh) {
                place_light(s, unit_quad_above(1, {0.5, 0, 0.5}));
                return;
            }
            s.meshes.push_back(
                {"quad", {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}, {}, {{0, 1, 2}, {0, 2, 3}}});
            s.meshes[0].uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            place_light(s, MeshInstance{});
        }));
        const PackedScene packed = pack_scene(scene.scene);
        for (const Light& light : packed.lights->all())
            EXPECT_GT(light.pmf, 0) << (mesh ? "mesh" : "quad");
        const double expected = 0.5 / pi * GetParam().expected;
        SCOPED_TRACE(mesh ? "mesh" : "quad");
        // 3e-3: a wide ray sees the texels' edge blurred over up to a hundredth of the quad.
        for (const bool light_sampling : {true, false})
            expect_mean(scene, expected, 3e-3, 64, light_sampling);
    }
}

// Lambert 1760: of the quad's left half, 0.5 by 1 at height 1, seen from under its corner.
constexpr double kLeftHalf = 0.2833226;

/// A disc shows one texel all over, that of its picture's corner.
TEST_F(GlTest, LightAndBsdfSamplingAgreeOnATexturedDisk)
{
    const DeviceScene scene(plane_under([](Scene& s) {
        s.images.push_back(half({128, 128, 128, 255}, {255, 255, 255, 255}));
        s.materials[1].emission_texture.image = 0;
        s.materials[1].emission_texture.wrap_u = Wrap::kClamp;
        place_light(s, Disk{{0, 2, 0}, {0, -1, 0}, 1});
        s.lights.push_back({.intensity = glm::vec3(1), .position = {0, 3, 0}});
    }));
    // pi r^2 / (r^2 + h^2) times 128 of sRGB; the point light is behind the disc.
    const double expected = 0.5 / pi * pi / 5 * 0.2158605;
    for (const bool light_sampling : {true, false})
        expect_mean(scene, expected, 2e-4, 64, light_sampling);
}

INSTANTIATE_TEST_SUITE_P(Lights, PatternTest,
    testing::Values(PatternCase{"TexturedEmission", kLeftHalf,
                        [](Scene& s) {
                            s.images.push_back(half({255, 255, 255, 255}, {0, 0, 0, 255}));
                            s.materials[1].emission_texture.image = 0;
                            s.materials[1].emission_texture.wrap_u = Wrap::kClamp;
                        }},
        PatternCase{"HalfOpaque", 0.5 * 0.43520988,
            [](Scene& s) {
                s.materials[1].alpha_mode = AlphaMode::kBlend;
                s.materials[1].opacity = 0.5F;
            }},
        PatternCase{"HalfCutOut", kLeftHalf,
            [](Scene& s) {
                s.images.push_back(half({255, 255, 255, 255}, {255, 255, 255, 0}));
                s.materials[1].alpha_mode = AlphaMode::kMask;
                s.materials[1].albedo_texture.image = 0;
                s.materials[1].albedo_texture.wrap_u = Wrap::kClamp;
            }}),
    [](const auto& test) { return test.param.name; });

/// Several kinds at once, side by side: irradiances add up.
TEST_F(GlTest, LightsOfSeveralKindsAddUp)
{
    const DeviceScene scene(plane_under([](Scene& s) {
        place_light(s, unit_quad_above(1, {0.5, 0, 0.5}));
        place_light(s, sphere_at_angle(2, 0.5, -0.6));
        s.lights.push_back({.intensity = glm::vec3(3),
            .position = 2.0 * glm::dvec3(0, std::cos(0.5), -std::sin(0.5))});
        s.lights.push_back({.kind = PunctualLight::Kind::kDirectional,
            .intensity = glm::vec3(2),
            .direction = glm::normalize(glm::dvec3(1, -2, -1))});
        s.lights.push_back({.name = "off", .intensity = glm::vec3(0)});
    }));
    const double expected = 0.43520988 + 0.162054 + 3 * std::cos(0.5) / 4 + 2 * 2 / std::sqrt(6.0);
    RenderSettings s;
    s.max_depth = 2;
    s.samples_per_pixel = 128;
    const Estimate estimate = mean_radiance(scene, s, 8);
    EXPECT_NEAR(estimate.mean, 0.5 / pi * expected,
        5 * estimate.standard_error + 2e-4 * 0.5 / pi * expected);
}

}  // namespace
}  // namespace farlight
