// The shaders of the probe, and what their numbers mean.
#include "lab/ray_probe.h"

#include "lab/compute.h"
#include "server/gl/buffer.h"
#include "server/gl/shader_source.h"

#include <algorithm>

namespace farlight {
namespace {

constexpr const char* kReadRay = R"(
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform samplerBuffer rays;
int ray_index() { return int(gl_GlobalInvocationID.x); }
bool is_ray(int i) { return i < textureSize(rays) / 2; }
Ray ray_at(int i) { return Ray(texelFetch(rays, 2 * i).xyz, texelFetch(rays, 2 * i + 1).xyz); }
)";

constexpr const char* kWriteHit = R"(
void write_hit(int i, Hit hit, vec3 normal, bool any, int accepted)
{
    // The slot is exact in two halves.
    results[3 * i] = vec4(hit.t, float(hit.slot & 0xffffu), float(hit.slot >> 16u), any ? 1.0 : 0.0);
    results[3 * i + 1] = vec4(hit.barycentric, float(accepted), 0.0);
    results[3 * i + 2] = vec4(normal, 0.0);
}
)";

constexpr const char* kByTree = R"(
void main()
{
    const int i = ray_index();
    if (!is_ray(i))
        return;
    const Ray ray = ray_at(i);
    const Hit hit = closest_hit(ray, T_INFINITY);
    write_hit(i, hit, surface_at(hit, ray).geometric_normal, any_hit(ray, T_INFINITY), 0);
}
)";

constexpr const char* kByEveryPrimitive = R"(
void main()
{
    const int i = ray_index();
    if (!is_ray(i))
        return;
    const Ray ray = ray_at(i);
    const Traversal prepared = prepare(ray);
    Hit hit = no_hit(T_INFINITY);
    int accepted = 0;
#ifdef FX_TRIANGLES
    for (int k = 0; k < textureSize(triangles) / TRIANGLE_TEXELS; ++k) {
        const vec3 a = uintBitsToFloat(texelFetch(triangles, k * TRIANGLE_TEXELS).xyz);
        const vec3 b = uintBitsToFloat(texelFetch(triangles, k * TRIANGLE_TEXELS + 1).xyz);
        const vec3 c = uintBitsToFloat(texelFetch(triangles, k * TRIANGLE_TEXELS + 2).xyz);
        vec2 barycentric;
        const float t = intersect_triangle(prepared, a, b, c, T_INFINITY, barycentric);
        accepted += t > 0.0 ? 1 : 0;
        if (t > 0.0 && t < hit.t)
            record(hit, prepared, t, BVH_TRIANGLES | uint(k), barycentric);
    }
#endif
#ifdef FX_SPHERES
    for (int k = 0; k < textureSize(spheres) / SPHERE_TEXELS; ++k) {
        const vec4 sphere = uintBitsToFloat(texelFetch(spheres, k * SPHERE_TEXELS));
        const float t = intersect_sphere(prepared, sphere.xyz, sphere.w, 0.0, T_INFINITY);
        accepted += t > 0.0 ? 1 : 0;
        if (t > 0.0 && t < hit.t)
            record(hit, prepared, t, BVH_SPHERES | uint(k), vec2(0.0));
    }
#endif
#ifdef FX_DISKS
    for (int k = 0; k < textureSize(disks) / DISK_TEXELS; ++k) {
        const vec4 disk = uintBitsToFloat(texelFetch(disks, k * DISK_TEXELS));
        const vec3 normal = uintBitsToFloat(texelFetch(disks, k * DISK_TEXELS + 1).xyz);
        const float t = intersect_disk(prepared, disk.xyz, normal, disk.w, T_INFINITY);
        accepted += t > 0.0 ? 1 : 0;
        if (t > 0.0 && t < hit.t)
            record(hit, prepared, t, BVH_DISKS | uint(k), vec2(0.0));
    }
#endif
    write_hit(i, hit, surface_at(hit, ray).geometric_normal, accepted > 0, accepted);
}
)";

/// Over a copy of the traversal that counts.
constexpr const char* kWork = R"(
void main()
{
    const int i = ray_index();
    if (!is_ray(i))
        return;
    closest_hit(ray_at(i), T_INFINITY);
    results[i] = vec4(float(opened_nodes), float(tested_primitives), 0.0, 0.0);
}
)";

std::string shader_of(const char* includes, const char* body)
{
    return std::string("#version 450\n") + includes + kReadRay + body;
}

constexpr const char* kSurface = "#include \"geometry/surface.glsl\"\n";

/// traverse.glsl with a count where each loop does its work.
std::string counting_traversal()
{
    std::string text = shader_files().at("geometry/traverse.glsl");
    const auto before = [&](const std::string& place, const std::string& count) {
        const std::size_t at = text.find(place);
        if (at == std::string::npos)
            throw std::logic_error("the traversal has no '" + place + "' to count at");
        text.insert(at, count);
    };
    before("struct NodeHit", "int opened_nodes = 0;\nint tested_primitives = 0;\n");
    before("NodeHit box = intersect_node(", "opened_nodes += inner ? 1 : 0;\n");
    before("intersect_primitive(ray, node, k,", "++tested_primitives;\n");
    return text;
}

ProbeHit hit_of(const glm::vec4* r)
{
    ProbeHit hit;
    hit.t = r[0].x;
    hit.slot = static_cast<std::uint32_t>(r[0].y) | (static_cast<std::uint32_t>(r[0].z) << 16);
    hit.any = r[0].w != 0;
    hit.barycentric = glm::vec2(r[1]);
    hit.accepted = static_cast<int>(r[1].z);
    hit.geometric_normal = glm::vec3(r[2]);
    return hit;
}

std::vector<ProbeHit> hits_of(const std::vector<glm::vec4>& results)
{
    std::vector<ProbeHit> hits;
    for (std::size_t i = 0; i < results.size(); i += 3)
        hits.push_back(hit_of(&results[i]));
    return hits;
}

}  // namespace

std::vector<glm::vec4> RayProbe::run(
    const std::string& shader, const std::vector<TestRay>& rays, std::size_t texels) const
{
    add_shader_file("lab/probe", shader);
    const Program program(load_shader_source("lab/probe", scene_.inputs.defines));
    std::vector<glm::vec4> packed;
    for (const TestRay& ray : rays) {
        packed.emplace_back(ray.origin, 0);
        packed.emplace_back(ray.direction, 0);
    }
    Buffer buffer("rays", std::as_bytes(std::span<const glm::vec4>(packed)));
    Inputs inputs = scene_.inputs.buffers;
    inputs["rays"] = buffer.texture(GL_RGBA32F);
    return run_compute(program, inputs, texels * rays.size(), rays.size());
}

std::vector<ProbeHit> RayProbe::by_tree(const std::vector<TestRay>& rays) const
{
    return hits_of(run(shader_of(kSurface, (std::string(kWriteHit) + kByTree).c_str()), rays, 3));
}

std::vector<ProbeHit> RayProbe::by_every_primitive(const std::vector<TestRay>& rays) const
{
    return hits_of(
        run(shader_of(kSurface, (std::string(kWriteHit) + kByEveryPrimitive).c_str()), rays, 3));
}

std::vector<glm::ivec2> RayProbe::work_of(const std::vector<TestRay>& rays) const
{
    add_shader_file("lab/counting_traversal", counting_traversal());
    std::vector<glm::ivec2> work;
    for (const glm::vec4& r :
        run(shader_of("#include \"lab/counting_traversal\"\n", kWork), rays, 1))
        work.emplace_back(r.x, r.y);
    return work;
}

glm::vec3 random_direction(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

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

Disagreements against_embree(const Scene& scene, const std::vector<TestRay>& rays)
{
    const DeviceScene on_device(scene);
    const PackedScene packed = pack_scene(scene);
    const EmbreeOracle oracle(packed);
    const std::vector<ProbeHit> hits = RayProbe(on_device).by_tree(rays);
    const Bounds bounds = scene_bounds(scene);
    const double extent = bounds.radius() + glm::length(bounds.center());
    Disagreements found;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RTCRayHit expected = oracle.closest(rays[i]);
        const bool expected_hit = expected.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        // At grazing incidence a unit of rounding in position is many in distance.
        const glm::vec3 normal =
            glm::normalize(glm::vec3(expected.hit.Ng_x, expected.hit.Ng_y, expected.hit.Ng_z));
        const double slope =
            expected_hit ? std::max(1e-3F, std::abs(glm::dot(normal, rays[i].direction))) : 1;
        const bool tie = std::abs(hits[i].t - expected.ray.tfar) <= 16 * 6e-8 * 2 * extent / slope;
        const bool same = hits[i].met() == expected_hit
            && (!expected_hit || hits[i].slot == expected.hit.primID || tie);
        found.wrong += same && hits[i].any == hits[i].met() ? 0 : 1;
        found.met += hits[i].met() ? 1 : 0;
    }
    return found;
}

}  // namespace farlight
