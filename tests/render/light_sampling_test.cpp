// Every way to sample a light against the density it claims: the directions of many samples fall
// into bins as often as the density, asked of rays that hit the lights, says they must.
//
// Seeds are fixed, so the tests are deterministic. With a fresh seed each would fail by chance once
// in 10 000 runs.
#include "lab/compute.h"
#include "lab/statistics.h"
#include "shaders/shared/frame_constants.h"
#include "tests/support/gl_test.h"

#include <functional>
#include <random>

namespace farlight {
namespace {

constexpr std::size_t kSamples = 1U << 16U;
constexpr std::size_t kRings = 8;
constexpr std::size_t kSectors = 16;
constexpr std::size_t kBins = kRings * kSectors;
constexpr std::size_t kPlaces = 128;  // along each side of a bin where its density is asked for
constexpr double kFalseAlarms = 1e-4;

/// Lights, and the point that samples them. Bins tile a cone of directions.
struct SamplingCase {
    const char* name;
    std::function<void(Scene&)> build;
    glm::vec3 position;
    glm::vec3 axis;  ///< Of the cone.
    float opening;  ///< 1 - cos of the cone's half angle; 2: all directions.
    glm::vec3 normal{0, 0, 1};

    friend void PrintTo(const SamplingCase& c, std::ostream* out) { *out << c.name; }
};

class LightSamplingTest : public GlTest, public testing::WithParamInterface<SamplingCase> {
protected:
    static Scene scene()
    {
        Scene scene;
        scene.materials.push_back({"light", glm::vec3(0), glm::vec3(1)});
        scene.materials.push_back({"dim light", glm::vec3(0), glm::vec3(0.2F)});
        GetParam().build(scene);
        for (Material& material : scene.materials)
            material.emits_both_sides = true;
        return scene;
    }

    static std::vector<glm::vec4> run(const DeviceScene& on_device, const char* entry,
        std::size_t results, std::size_t invocations)
    {
        const SamplingCase& c = GetParam();
        add_shader_file("tests/light_sampling", kShader);
        Defines defines = on_device.inputs.defines;
        defines.emplace_back(entry, "1");
        defines.emplace_back("BINS", std::to_string(kBins) + "u");
        defines.emplace_back("SECTORS", std::to_string(kSectors) + "u");
        defines.emplace_back("PLACES", std::to_string(kPlaces) + "u");
        const Program program(load_shader_source("tests/light_sampling", defines));
        shared::FrameConstants frame{};
        frame.background = on_device.scene.background;
        frame.light_count = on_device.shared.light_count;
        const Buffer block(
            "frame", std::as_bytes(std::span<const shared::FrameConstants, 1>(&frame, 1)));
        if (const auto found = program.uniform_blocks().find("frame_block");
            found != program.uniform_blocks().end())
            glBindBufferBase(GL_UNIFORM_BUFFER, found->second, block.id());
        const auto set = [&](const char* name, const glm::vec3& value) {
            glProgramUniform3f(
                program.id(), glGetUniformLocation(program.id(), name), value.x, value.y, value.z);
        };
        set("position", c.position);
        set("normal", c.normal);
        set("axis", glm::normalize(c.axis));
        glProgramUniform1f(program.id(), glGetUniformLocation(program.id(), "opening"), c.opening);
        return run_compute(program, on_device.inputs.buffers, results, invocations);
    }

    static constexpr const char* kShader = R"(#version 450
#include "lib/random.glsl"
#include "lights/lights.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform vec3 position;
uniform vec3 normal;
uniform vec3 axis;
uniform float opening;

// The density of finding, along `wi`, what a ray along it meets.
float hit_pdf(vec3 wi)
{
    const Ray ray = Ray(position, wi);
    const Hit hit = closest_hit(ray, T_INFINITY);
    const Surface s = surface_at(hit, ray);
    return hit.slot != NO_HIT && s.light != 0u
        ? light_pdf(s.light - 1u, position, normal, s.position, s.geometric_normal) : 0.0;
}

void main()
{
    const uint i = gl_GlobalInvocationID.x;
#ifdef SAMPLES
    const LightSample s = sample_lights(position, normal, random4(uvec2(i, 0u), 1u, i, 0u, SLOT_LIGHT));
    const vec3 local = s.wi * basis_around(axis);
    const float density = s.delta ? s.pdf : s.infinite ? environment_pdf(s.wi) : hit_pdf(s.wi);
    results[i] = vec4(s.pdf > 0.0 ? 1.0 - local.z : 3.0, atan(local.y, local.x), s.delta ? -1.0 : s.pdf, density);
#else
    // Part of the mass of a bin: the mean density over a row of jittered places in it.
    const uint bin = i / PLACES, row = i % PLACES;
    float sum = 0.0;
    for (uint k = 0u; k < PLACES; ++k) {
        const vec2 place = (vec2(row, k) + random4(uvec2(i, k), 2u, 0u, 0u, 0u).xy) / float(PLACES);
        const vec2 at = (vec2(bin / SECTORS, bin % SECTORS) + place) / vec2(BINS / SECTORS, SECTORS);
        const vec3 wi = basis_around(axis) * sample_cone(at, opening);
        sum += hit_pdf(wi) + environment_pdf(wi);
    }
    float without_extent = 0.0;
#ifdef FX_DELTA_LIGHTS
    for (uint k = 0u; k < (i == 0u ? frame.light_count : 0u); ++k) {
        const Light light = load_light(k);
        without_extent += is_delta(light)
            ? (light.kind == LIGHT_DIRECTIONAL ? light.pmf : light_pmf(light, position, normal)) : 0.0;
    }
#endif
    results[i] = vec4(sum / float(PLACES * PLACES) * 2.0 * PI * opening / float(BINS), without_extent, 0.0, 0.0);
#endif
}
)";
};

TEST_P(LightSamplingTest, SamplesFollowTheDensityOfHits)
{
    const DeviceScene on_device(scene());
    const std::vector<glm::vec4> density =
        run(on_device, "DENSITY", kBins * kPlaces, kBins * kPlaces);
    const std::vector<glm::vec4> samples = run(on_device, "SAMPLES", kSamples, kSamples);
    // After the bins: everything else, then lights without extent.
    std::vector<double> expected(kBins + 2, 0);
    std::vector<double> observed(kBins + 2, 0);
    double rest = 1;
    for (std::size_t i = 0; i < density.size(); ++i) {
        expected[i / kPlaces] += static_cast<double>(density[i].x) * kSamples;
        rest -= static_cast<double>(density[i].x);
    }
    expected[kBins + 1] = static_cast<double>(density[0].y) * kSamples;
    expected[kBins] = std::max(rest * kSamples - expected[kBins + 1], 0.0);

    double agreeing = 0;
    for (const glm::vec4& s : samples) {
        const auto ring = static_cast<std::size_t>(s.x / GetParam().opening * kRings);
        const double turn = static_cast<double>(s.y) / (2 * 3.14159265358979);
        const auto sector = static_cast<std::size_t>((turn - std::floor(turn)) * kSectors);
        const bool inside = s.x >= 0 && ring < kRings && sector < kSectors;
        const std::size_t bin = s.z < 0 ? kBins + 1 : inside ? ring * kSectors + sector : kBins;
        observed[bin] += 1;
        agreeing += s.z < 0 || std::abs(s.z - s.w) <= 0.01F * s.z ? 1 : 0;
    }
    EXPECT_GT(chi_squared_p_value(expected, observed), kFalseAlarms);
    // Rounding makes a ray miss a light at its silhouette, or meet the next texel of a map.
    EXPECT_GT(agreeing, 0.995 * kSamples);
}

void add_light(Scene& scene, const std::variant<Sphere, Quad, MeshInstance, Disk>& shape)
{
    scene.objects.push_back({"light", 0, shape});
}

void add_triangle(Scene& scene, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c)
{
    scene.meshes.push_back({"triangle", {a, b, c}, {}, {{0, 1, 2}}});
    add_light(scene, MeshInstance{static_cast<std::uint32_t>(scene.meshes.size()) - 1});
}

/// A map of random texels, one much brighter than the rest, turned against the world.
void add_map(Scene& scene, std::uint32_t width, std::uint32_t height, std::size_t hot)
{
    std::mt19937 random(7);
    EnvironmentMap map{"map", width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
        map.texels.emplace_back(static_cast<float>(random() % 5));
    map.texels[hot] = glm::vec3(40);
    scene.environment = std::make_shared<EnvironmentMap>(map);
    scene.background = glm::vec3(0.5F);
    scene.map_from_world = {{0.6F, 0.8F, 0}, {-0.8F, 0.6F, 0}, {0, 0, 1}};
}

void add_everything(Scene& scene)
{
    add_light(scene, Sphere{{0, 0, 4}, 1});
    add_light(scene, Sphere{{4, 0, -1}, 0.5});
    add_light(scene, Quad{{-4, -1, -1}, {0, 2, 0}, {0, 0, 2}});
    add_light(scene, Disk{{0, 3, 0}, {0, 0.6, 0.8}, 1});
    add_triangle(scene, {0, -3, 0}, {1, -3, 1}, {-1, -3.5F, 1});
    scene.objects.back().material = 1;
    add_map(scene, 16, 8, 70);
    scene.background = glm::vec3(0.05F);
    scene.lights.push_back({.name = "point", .position = {1, 1, 1}});
    scene.lights.push_back(
        {.name = "sun", .kind = PunctualLight::Kind::kDirectional, .intensity = glm::vec3(0.1F)});
    scene.lights.push_back({.name = "off", .intensity = glm::vec3(0)});
}

const std::vector<SamplingCase>& sampling_cases()
{
    static const Quad quad{{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}};
    static const std::vector<SamplingCase> cases{
        {"Quad", [](Scene& s) { add_light(s, quad); }, {0.3F, 0.1F, 0}, {0, 0, 1}, 0.6F},
        {"QuadFromBehind", [](Scene& s) { add_light(s, quad); }, {0, 0, 5}, {0, 0, -1}, 0.3F},
        {"QuadAlmostEdgeOn", [](Scene& s) { add_light(s, quad); }, {2, 0, 1.9F}, {-1, 0, 0}, 0.5F},
        {"QuadTouching", [](Scene& s) { add_light(s, quad); }, {0.5F, 0, 1.95F}, {0, 0, 1}, 1},
        {"Triangle",
            [](Scene& s) {
                add_triangle(s, {1, .2F, 2}, {-.5F, 1, 1.5F}, {-.7F, -.9F, 2.5F});
            },
            {0, 0, 0}, {0, 0, 1}, 0.4F},
        {"Disk",
            [](Scene& s) {
                add_light(s, Disk{{0, 0, 2}, {0.6, 0, -0.8}, 1});
            },
            {0, 0, 0}, {0, 0, 1}, 0.2F},
        {"SphereFar",
            [](Scene& s) {
                add_light(s, Sphere{{60, 0, 80}, 1});
            },
            {0, 0, 0}, {0.6F, 0, 0.8F}, 6e-5F},
        {"SphereAside",
            [](Scene& s) {
                add_light(s, Sphere{{0, 1, 2}, 1});
            },
            {0, 0, 0}, {0, 1, 2}, 0.12F},
        {"SphereNear",
            [](Scene& s) {
                add_light(s, Sphere{{0, 0, 1.001}, 1});
            },
            {0, 0, 0}, {0, 0, 1}, 1},
        {"SphereInside",
            [](Scene& s) {
                add_light(s, Sphere{{0, 0, 1}, 2});
            },
            {0.5F, 0.2F, 0}, {0, 0, 1}, 2},
        {"Map", [](Scene& s) { add_map(s, 16, 8, 37); }, {0, 0, 0}, {0.3F, 0.5F, -0.8F}, 2},
        {"MapHotAtThePole", [](Scene& s) { add_map(s, 9, 5, 2); }, {0, 0, 0}, {-0.8F, 0.6F, 0}, 2},
        {"MapHotAtTheSeam", [](Scene& s) { add_map(s, 7, 4, 20); }, {0, 0, 0}, {0, 0, 1}, 2},
        {"MapOfOneRow", [](Scene& s) { add_map(s, 2, 1, 0); }, {0, 0, 0}, {0, 0, 1}, 2},
        {"Everything", add_everything, {0.2F, 0.1F, 0}, {0, 0, 1}, 2},
    };
    return cases;
}

INSTANTIATE_TEST_SUITE_P(Lights, LightSamplingTest, testing::ValuesIn(sampling_cases()),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
