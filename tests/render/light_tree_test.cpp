// The light tree on the device: it chooses each light as often as it says, and of many lights those
// that matter.
//
// Seeds are fixed, so the tests are deterministic. With a fresh seed a chi-squared test would fail
// by chance once in 10 000 runs.
#include "lab/compute.h"
#include "lab/statistics.h"
#include "server/scene/flatten.h"
#include "tests/support/gl_test.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <random>

namespace farlight {
namespace {

constexpr std::size_t kPoints = 48;
constexpr std::size_t kDraws = 4096;  // a point

/// Makes the device choose the scene's lights by power, as if they were too few for a tree.
void drop_tree(const DeviceScene& on_device)
{
    const TextureLayout layout(on_device.scene.images);
    const LightTable by_power(
        on_device.scene, layout, flatten(on_device.scene).lights, on_device.shared.light_count + 1);
    const auto overwrite = [&](const char* name, const Texels& texels) {
        GLint buffer = 0;
        glGetTextureLevelParameteriv(
            on_device.inputs.buffers.at(name), 0, GL_TEXTURE_BUFFER_DATA_STORE_BINDING, &buffer);
        glNamedBufferSubData(static_cast<GLuint>(buffer), 0,
            static_cast<GLsizeiptr>(texels.size() * sizeof texels[0]), texels.data());
    };
    overwrite("lights", by_power.lights());
    overwrite("light_tree", {glm::uvec4(0)});
}

/// Lights of every kind that has a place, facing all ways, some of them very strong; a sun and one
/// that is off.
Scene mixed_lights(std::size_t count)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)));
    };
    Scene scene;
    scene.materials = {{"dim", glm::vec3(0), glm::vec3(1)}, {"bright", glm::vec3(0), glm::vec3(50)},
        {"both", glm::vec3(0), glm::vec3(2), true}};
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 at = 5.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
        const glm::dvec3 way = direction();
        const auto material = static_cast<std::uint32_t>(random() % 3);
        switch (i % 5) {
        case 0: scene.objects.push_back({"sphere", material, Sphere{at, 0.1}}); break;
        case 1: scene.objects.push_back({"disk", material, Disk{at, way, 0.2}}); break;
        case 2:
            scene.objects.push_back(
                {"quad", material, Quad{at, 0.3 * way, 0.3 * glm::cross(way, direction())}});
            break;
        case 3: scene.lights.push_back({.name = "point", .position = at}); break;
        default:
            scene.lights.push_back({.name = "spot",
                .kind = PunctualLight::Kind::kSpot,
                .intensity = glm::vec3(20),
                .position = at,
                .direction = way});
        }
    }
    scene.lights.push_back({.name = "sun", .kind = PunctualLight::Kind::kDirectional});
    scene.lights.push_back({.name = "off", .intensity = glm::vec3(0)});
    return scene;
}

class LightTreeTest : public GlTest {
protected:
    /// Runs `body` for each of kPoints points and normals; it sees `i`, `position` and `normal`.
    static std::vector<glm::vec4> at_points(
        const DeviceScene& lights, const std::string& body, std::size_t results)
    {
        add_shader_file("tests/light_tree", R"(#version 450
#include "lib/random.glsl"
#include "lights/lights.glsl"
layout(local_size_x = 1) in;
layout(std430) buffer output_block { vec4 results[]; };
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    const vec4 u = random4(uvec2(i, 5u), 3u, 0u, 0u, 0u);
    const vec3 position = (u.xyz - 0.5) * 12.0;
    const vec3 normal = i % 4u == 0u ? vec3(0.0) : sample_cone(vec2(u.w, fract(u.x * 4096.0)), 2.0);
)" + body + "}\n");
        Defines defines = lights.inputs.defines;
        defines.emplace_back("LIGHT_COUNT", std::to_string(lights.shared.light_count) + "u");
        const Program program(load_shader_source("tests/light_tree", defines));
        return run_compute(program, lights.inputs.buffers, results, kPoints);
    }
};

TEST_F(LightTreeTest, ProbabilitiesSumToOne)
{
    // All shine on both sides or all round, so nothing is out of sight of all.
    Scene scene = mixed_lights(200);
    for (Material& material : scene.materials)
        material.emits_both_sides = true;
    for (PunctualLight& light : scene.lights)
        if (light.kind == PunctualLight::Kind::kSpot)
            light.kind = PunctualLight::Kind::kPoint;
    const DeviceScene lights(scene);
    const std::vector<glm::vec4> sums = at_points(lights, R"(
    float sum = 0.0;
    for (uint light = 0u; light < LIGHT_COUNT; ++light) {
        const Light l = load_light(light);
        sum += l.kind == LIGHT_DIRECTIONAL ? l.pmf : light_pmf(l, position, normal);
    }
    results[i] = vec4(sum);
)",
        kPoints);
    for (std::size_t i = 0; i < kPoints; ++i)
        // 2e-5: 203 sums and up to 16 products rounded to 24 bits.
        EXPECT_NEAR(sums[i].x, 1, 2e-5) << "point " << i;
}

TEST_F(LightTreeTest, ChoosesEachLightAsOftenAsItSays)
{
    const DeviceScene lights(mixed_lights(100));
    const std::size_t count = lights.shared.light_count;
    const std::vector<glm::vec4> results = at_points(lights, R"(
    for (uint light = 0u; light < LIGHT_COUNT; ++light) {
        const Light l = load_light(light);
        const bool placed = l.kind != LIGHT_DIRECTIONAL;
        results[i * LIGHT_COUNT + light] = vec4(0.0, placed ? light_pmf(l, position, normal) : l.pmf, 0.0, 0.0);
    }
    for (uint k = 0u; k < 4096u; ++k) {
        float pmf;
        const uint light = choose_light(position, normal, random4(uvec2(i, k), 1u, 0u, 0u, 0u), pmf);
        const uint at = i * LIGHT_COUNT + light;
        if (pmf > 0.0) {
            results[at].x += 1.0;
            results[at].z = max(results[at].z, abs(pmf - results[at].y) / pmf);
        }
    }
)",
        kPoints * count);
    double statistic = 0;
    double freedom = 0;
    const auto compare = [&](double observed, double expected) {
        statistic += (observed - expected) * (observed - expected) / expected;
        freedom += 1;
    };
    for (std::size_t i = 0; i < kPoints; ++i) {
        double rest_observed = 0;
        double rest_expected = 0;
        freedom -= 1;  // a point's draws are so many in all
        for (std::size_t light = 0; light < count; ++light) {
            const glm::vec4& r = results[i * count + light];
            EXPECT_LE(r.z, 1e-5) << "the choice and the question disagree about light " << light;
            EXPECT_TRUE(r.y > 0 || r.x == 0) << "light " << light << " was never to be chosen";
            const double expected = static_cast<double>(r.y) * kDraws;
            if (expected >= 10) {
                compare(static_cast<double>(r.x), expected);
            } else {
                rest_observed += static_cast<double>(r.x);
                rest_expected += expected;
            }
        }
        if (rest_expected >= 5)
            compare(rest_observed, rest_expected);
    }
    // Of all points together, so that a bias too small for one is seen.
    EXPECT_GT(
        boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), statistic)),
        1e-4);
}

/// n x n small lamps close over a wide floor, of which a plane's piece in the middle is seen.
Scene lamp_field(int n)
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)}, {"light", glm::vec3(0), glm::vec3(10)}};
    scene.objects.push_back({"floor", 0, Quad{{-20, 0, -20}, {0, 0, 40}, {40, 0, 0}}});
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            scene.objects.push_back({"lamp", 1,
                Quad{{i - 0.5 * n + 0.4, 0.5, j - 0.5 * n + 0.4}, {0.2, 0, 0}, {0, 0, 0.2}}});
    scene.camera.position = {0.9, 0.4, 0.3};
    scene.camera.target = {0.4, 0, 0.1};
    scene.camera.vertical_fov_degrees = 1;
    return scene;
}

Estimate radiance(const DeviceScene& lights, bool light_sampling, int samples)
{
    RenderSettings s;
    s.max_depth = 2;
    s.light_sampling = light_sampling;
    s.samples_per_pixel = samples;
    s.denoiser = Denoiser::kAccumulate;
    View view(lights.shared);
    RenderedFrame frame;
    for (int i = 0; i < 4; ++i)
        frame = view.render(linear_request(lights.scene, {32, 32}, s));
    EXPECT_EQ(frame.bad_values.all(), 0U);
    return mean_of(frame.image);
}

TEST_F(LightTreeTest, AgreesWithSamplingByPowerAndIsMuchLessNoisy)
{
    const DeviceScene scene(lamp_field(16));
    ASSERT_TRUE(scene.inputs.calls_for("FX_LIGHT_TREE"));
    const Estimate tree = radiance(scene, true, 16);
    const Estimate chance = radiance(scene, false, 64);
    drop_tree(scene);
    const Estimate power = radiance(scene, true, 16);
    EXPECT_NEAR(tree.mean, power.mean, 5 * std::hypot(tree.standard_error, power.standard_error));
    EXPECT_NEAR(tree.mean, chance.mean, 5 * std::hypot(tree.standard_error, chance.standard_error));
    // A tenth of the variance is what 256 lamps leave, of which four are near.
    EXPECT_LT(tree.standard_error, power.standard_error / std::sqrt(10.0));
}

}  // namespace
}  // namespace farlight
