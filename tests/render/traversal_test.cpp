// Traversal on the device against Embree, ray by ray; and rays aimed where two triangles meet.
#include "lab/compute.h"
#include "lab/embree_oracle.h"
#include "lab/meshes.h"
#include "server/gl/buffer.h"
#include "shaders/shared/scene_layout.h"
#include "tests/support/gl_test.h"

#include <fstream>
#include <random>

namespace farlight {
namespace {

struct DeviceHit {
    float t;
    std::uint32_t slot;
    bool any;
};

constexpr const char* kTraceShader = R"(#version 450
#include "geometry/traverse.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform samplerBuffer rays;
void main()
{
    const int i = int(gl_GlobalInvocationID.x);
    if (i >= results.length())
        return;
    const Ray ray = Ray(texelFetch(rays, 2 * i).xyz, texelFetch(rays, 2 * i + 1).xyz);
    const Hit hit = closest_hit(ray, T_INFINITY);
    results[i] = vec4(hit.t, float(hit.slot & 0xffffu), float(hit.slot >> 16u),  // exact in two halves
        any_hit(ray, T_INFINITY) ? 1.0 : 0.0);
}
)";

std::vector<DeviceHit> trace_on_device(const DeviceScene& scene, const std::vector<TestRay>& rays)
{
    add_shader_file("tests/trace", kTraceShader);
    const Program program(load_shader_source("tests/trace", scene.inputs.defines));
    std::vector<glm::vec4> texels;
    for (const TestRay& ray : rays) {
        texels.emplace_back(ray.origin, 0);
        texels.emplace_back(ray.direction, 0);
    }
    Buffer buffer("rays", std::as_bytes(std::span<const glm::vec4>(texels)));
    Inputs inputs = scene.inputs.buffers;
    inputs["rays"] = buffer.texture(GL_RGBA32F);
    std::vector<DeviceHit> hits;
    for (const glm::vec4& r : run_compute(program, inputs, rays.size(), rays.size()))
        hits.push_back({r.x,
            static_cast<std::uint32_t>(r.y) | (static_cast<std::uint32_t>(r.z) << 16), r.w != 0});
    return hits;
}

glm::vec3 random_direction(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

/// Half from around the scene towards it, half from inside it anywhere.
std::vector<TestRay> random_rays(const Bounds& bounds, std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const glm::vec3 half = glm::vec3(bounds.upper - bounds.lower) * 0.5F;
    const auto inside = [&] {
        return glm::vec3(bounds.center())
            + half * glm::vec3(uniform(random), uniform(random), uniform(random));
    };
    std::vector<TestRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 2 == 0) {
            rays.push_back({inside(), random_direction(random)});
        } else {
            const glm::vec3 from = glm::vec3(bounds.center())
                + 2.0F * static_cast<float>(bounds.radius()) * random_direction(random);
            rays.push_back({from, glm::normalize(inside() - from)});
        }
    }
    return rays;
}

std::optional<Scene> scene_named(const std::string& name)
{
    const std::string root = FARLIGHT_SOURCE_DIR;
    if (name == "soup")
        return scene_of(triangle_soup(20'000, 5));
    if (name == "fine_soup")
        return scene_of(triangle_soup(100'000, 6));
    if (name == "bumps")
        return scene_of(bumpy_sphere(250, 140));
    if (name == "cornell_box" || name == "mesh")
        return load_scene(root + "/scenes/" + name + ".json");
    const std::string balloon = root + "/../shared/data/balloon/scene.gltf";
    return std::ifstream(balloon) ? std::optional(load_scene(balloon)) : std::nullopt;
}

class TraversalTest : public GlTest, public testing::WithParamInterface<const char*> { };

/// The same primitive, or a tie: another at the same distance within 16 ulp of the coordinates
/// involved.
TEST_P(TraversalTest, EqualsEmbreeForAHundredThousandRays)
{
    std::optional<Scene> scene = scene_named(GetParam());
    if (!scene)
        GTEST_SKIP() << "the model is not on this machine";
    std::erase_if(
        scene->objects, [](const Object& object) { return !object.framed; });  // a default lamp
    const DeviceScene on_device(*scene);
    const PackedScene packed = pack_scene(*scene);
    const EmbreeOracle oracle(packed);
    const Bounds bounds = scene_bounds(*scene);
    const std::vector<TestRay> rays = random_rays(bounds, 100'000, 17);
    const std::vector<DeviceHit> hits = trace_on_device(on_device, rays);

    const double extent = bounds.radius() + glm::length(bounds.center());
    std::size_t wrong = 0;
    std::size_t met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RTCRayHit expected = oracle.closest(rays[i]);
        const bool hit = hits[i].slot != 0xffffffffU;
        const bool expected_hit = expected.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        // At grazing incidence a unit of rounding in position is many in distance.
        const glm::vec3 normal =
            glm::normalize(glm::vec3(expected.hit.Ng_x, expected.hit.Ng_y, expected.hit.Ng_z));
        const double slope =
            expected_hit ? std::max(1e-3F, std::abs(glm::dot(normal, rays[i].direction))) : 1;
        const bool tie = std::abs(hits[i].t - expected.ray.tfar) <= 16 * 6e-8 * 2 * extent / slope;
        const bool same =
            hit == expected_hit && (!hit || hits[i].slot == expected.hit.primID || tie);
        wrong += same && hits[i].any == hit ? 0 : 1;
        met += hit ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(met, rays.size() / 10) << "the rays hardly met anything";
}

INSTANTIATE_TEST_SUITE_P(Meshes, TraversalTest,
    testing::Values("cornell_box", "mesh", "balloon", "bumps", "soup", "fine_soup"),
    [](const auto& test) { return std::string(test.param); });

class LeakTest : public GlTest, public testing::WithParamInterface<float> { };

/// From inside a closed mesh every ray hits it: a million, a third aimed at vertices, a third at
/// edges.
TEST_P(LeakTest, NoRaySlipsBetweenTriangles)
{
    const glm::vec3 center(GetParam(), -0.5F * GetParam(), 0.25F * GetParam());
    Scene scene = scene_of(bumpy_sphere(120, 60, center));
    const PackedScene packed = pack_scene(scene);
    const DeviceScene on_device(std::move(scene));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::size_t missed = 0;
    for (int batch = 0; batch < 10; ++batch) {
        std::vector<TestRay> rays;
        for (int i = 0; i < 100'000; ++i) {
            const auto first = static_cast<std::size_t>(3 * (random() % packed.content.triangles));
            const auto vertex = [&](std::size_t k) {
                return glm::uintBitsToFloat(glm::uvec3(packed.geometry.triangles[first + k]));
            };
            const glm::vec3 origin = center
                + 0.5F * (glm::vec3(uniform(random), uniform(random), uniform(random)) - 0.5F);
            glm::vec3 target = vertex(i % 3);
            if (i % 3 == 1)
                target = glm::mix(vertex(0), vertex(1), uniform(random));
            rays.push_back(
                {origin, i % 3 == 2 ? random_direction(random) : glm::normalize(target - origin)});
        }
        for (const DeviceHit& hit : trace_on_device(on_device, rays))
            missed += hit.slot == 0xffffffffU || !hit.any ? 1 : 0;
    }
    EXPECT_EQ(missed, 0U);
}

INSTANTIATE_TEST_SUITE_P(Offsets, LeakTest, testing::Values(0.0F, 1e3F, 1e5F),
    [](const auto& test) { return "At" + std::to_string(static_cast<int>(test.param)); });

}  // namespace
}  // namespace farlight
