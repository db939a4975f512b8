// Precision: what the primitive tests make of numbers far apart, against the same in double
// precision.
#include "lab/compute.h"
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/ray_probe.h"

#include "server/gl/buffer.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr double kUlp = 1.1920929e-7;  ///< Of 1, in single precision.

/// A ray and a primitive: origin, direction, then three vertices or center with radius.
constexpr int kQueryTexels = 5;
using Query = std::array<glm::vec4, kQueryTexels>;

constexpr const char* kIntersectHead = R"(#version 450
#include "geometry/ray.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform samplerBuffer queries;
vec4 query(int k) { return texelFetch(queries, 5 * int(gl_GlobalInvocationID.x) + k); }
void main()
{
    if (gl_GlobalInvocationID.x >= uint(results.length()))
        return;
    const Traversal ray = prepare(Ray(query(0).xyz, query(1).xyz));
)";
constexpr const char* kIntersectTriangle = R"(
    vec2 barycentric;
    const float t = intersect_triangle(ray, query(2).xyz, query(3).xyz, query(4).xyz, T_INFINITY, barycentric);
    results[gl_GlobalInvocationID.x] = vec4(t, barycentric, 0.0);
}
)";
constexpr const char* kIntersectSphere = R"(
    results[gl_GlobalInvocationID.x] = vec4(intersect_sphere(ray, query(2).xyz, query(2).w, 0.0, T_INFINITY));
}
)";

std::vector<glm::vec4> intersect(const char* body, const std::vector<Query>& queries)
{
    add_shader_file("lab/intersect", std::string(kIntersectHead) + body);
    const Program program(load_shader_source("lab/intersect"));
    Buffer buffer("queries", std::as_bytes(std::span<const Query>(queries)));
    return run_compute(
        program, {{"queries", buffer.texture(GL_RGBA32F)}}, queries.size(), queries.size());
}

/// A triangle of edges about `size` around a point `distance` from the ray's origin, and a ray at
/// its inside or at its plane beside it; every fifth goes the other way.
Query triangle_query(std::mt19937& random, float distance, float size)
{
    std::uniform_real_distribution<float> uniform(0, 1);
    const glm::vec3 origin = distance * random_direction(random);
    std::array<glm::vec3, 3> v{};
    for (glm::vec3& corner : v)
        corner = size * random_direction(random);
    const float s = std::sqrt(uniform(random));
    const float r = uniform(random);
    const float stretch = random() % 3 == 0 ? 2.0F : 1.0F;
    const glm::vec3 target = v[0] + stretch * s * ((1 - r) * (v[1] - v[0]) + r * (v[2] - v[0]));
    const float way = random() % 5 == 0 ? -1.0F : 1.0F;
    return {glm::vec4(origin, 0), glm::vec4(way * glm::normalize(target - origin), 0),
        glm::vec4(v[0], 0), glm::vec4(v[1], 0), glm::vec4(v[2], 0)};
}

/// Where the ray meets the triangle's plane, in double: t, and weights of the second and third
/// vertex; and the cosine it meets it by.
struct PlaneHit {
    double t;
    glm::dvec2 barycentric;
    double cosine;
    double altitude;  ///< The triangle's least.
};

PlaneHit plane_hit(const Query& q)
{
    const glm::dvec3 o(q[0]);
    const glm::dvec3 d(q[1]);
    const glm::dvec3 e1 = glm::dvec3(q[3]) - glm::dvec3(q[2]);
    const glm::dvec3 e2 = glm::dvec3(q[4]) - glm::dvec3(q[2]);
    const glm::dvec3 s = o - glm::dvec3(q[2]);
    const glm::dvec3 p = glm::cross(d, e2);
    const glm::dvec3 k = glm::cross(s, e1);
    const double determinant = glm::dot(e1, p);
    const glm::dvec3 n = glm::cross(e1, e2);
    const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
    return {glm::dot(e2, k) / determinant,
        {glm::dot(s, p) / determinant, glm::dot(d, k) / determinant},
        std::abs(glm::dot(n, d)) / (glm::length(n) * glm::length(d)), glm::length(n) / longest};
}

/// Distance along the ray and point by weights are off by roundings of the largest difference of
/// coordinates, more so where the ray grazes; weights by that in altitudes of the triangle.
void triangle_hits_are_exact(Findings& findings, Length length)
{
    std::mt19937 random(5);
    const std::size_t count = length == Length::kLong ? 300'000 : 20'000;
    for (const auto& [distance, size] :
        {std::pair(1.0F, 1.0F), std::pair(1e3F, 1.0F), std::pair(1e5F, 1.0F),
            std::pair(1e-3F, 1.0F), std::pair(1e-6F, 1e-6F), std::pair(1e6F, 1e6F)}) {
        std::vector<Query> queries;
        for (std::size_t i = 0; i < count; ++i)
            queries.push_back(triangle_query(random, distance, size));
        const std::vector<glm::vec4> found = intersect(kIntersectTriangle, queries);
        double t_off = 0;
        double weights_off = 0;
        std::size_t wrong = 0;
        std::size_t met = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const PlaneHit exact = plane_hit(queries[i]);
            const double unit = kUlp * (distance + size) / exact.cosine;
            // Nearer to an edge than this, or to the origin, rounding decides.
            const double margin = 4 * unit / exact.altitude;
            const auto& [u, v] = std::pair(exact.barycentric.x, exact.barycentric.y);
            const double within = std::min({u, v, 1 - u - v});
            if (!(std::abs(within) > margin && std::abs(exact.t) > 4 * unit))
                continue;
            const bool meets = within > 0 && exact.t > 0;
            wrong += (found[i].x > 0) == meets ? 0 : 1;
            met += meets ? 1 : 0;
            if (!meets || !(found[i].x > 0))
                continue;
            t_off = farther(t_off, std::abs(found[i].x - exact.t) / unit);
            weights_off = farther(weights_off,
                farther(std::abs(found[i].y - u), std::abs(found[i].z - v)) * exact.altitude
                    / unit);
        }
        char name[64];
        std::snprintf(name, sizeof name, "%g m away, %g m large: ", distance, size);
        findings.none(
            std::string(name) + "hits and misses told wrongly", static_cast<double>(wrong));
        findings.at_least(std::string(name) + "share of rays that meet it",
            static_cast<double>(met) / static_cast<double>(count), 0.1);
        findings.at_most(std::string(name) + "distance off [ulp]", t_off, 8);
        findings.at_most(std::string(name) + "weights off [ulp]", weights_off, 8);
    }
}

/// A meadow of triangles of 1 m seen from a million away in all directions but along it: whether
/// the one aimed at is met.
void tiny_triangles_far_away(Findings& findings, Length length)
{
    constexpr int kSide = 100;
    Mesh meadow{"meadow", {}, {}, {}};
    for (int j = 0; j <= kSide; ++j)
        for (int i = 0; i <= kSide; ++i)
            meadow.positions.emplace_back(i - kSide / 2, 0, j - kSide / 2);
    for (unsigned j = 0; j < kSide; ++j)
        for (unsigned i = 0; i < kSide; ++i) {
            const unsigned at = j * (kSide + 1) + i;
            meadow.triangles.emplace_back(at, at + kSide + 1, at + 1);
            meadow.triangles.emplace_back(at + 1, at + kSide + 1, at + kSide + 2);
        }
    const Scene scene = scene_of(meadow);
    const PackedScene packed = pack_scene(scene);
    const auto middle_of = [&](std::uint32_t slot) {
        const auto vertex = [&](std::size_t k) {
            return glm::uintBitsToFloat(
                glm::uvec3(packed.geometry.triangles[std::size_t{3} * slot + k]));
        };
        return (vertex(0) + vertex(1) + vertex(2)) / 3.0F;
    };
    std::mt19937 random(4);
    std::vector<TestRay> rays;
    std::vector<std::uint32_t> aimed_at;
    const std::size_t count = length == Length::kLong ? 1'000'000 : 100'000;
    while (rays.size() < count) {
        // Every tenth from straight above, as a satellite would.
        const glm::vec3 from =
            rays.size() % 10 == 0 ? glm::vec3(0, 1, 0) : random_direction(random);
        if (from.y < 0.3F)  // at 17 degrees a triangle is as high as 5 ulp are long
            continue;
        aimed_at.push_back(static_cast<std::uint32_t>(random() % packed.content.triangles));
        const glm::vec3 target = middle_of(aimed_at.back());
        const glm::vec3 origin = target + 1e6F * from;
        rays.push_back({origin, glm::normalize(target - origin)});
    }
    const DeviceScene on_device(scene);
    const std::vector<ProbeHit> hits = RayProbe(on_device).by_tree(rays);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i)
        wrong += hits[i].slot == aimed_at[i] ? 0 : 1;
    findings.at_most("share of rays that meet another triangle or none",
        static_cast<double>(wrong) / static_cast<double>(count), 2e-5);
}

/// Distance to the first side of a sphere beyond 0 in double, or a negative number; how far the
/// ray passes the middle; and how steeply it meets it.
struct ExactSphereHit {
    double t = -1;
    double passes;
    double cosine;
};

ExactSphereHit exact_sphere_hit(const Query& q)
{
    const glm::dvec3 f = glm::dvec3(q[0]) - glm::dvec3(q[2]);
    const double scale = glm::length(glm::dvec3(q[1]));
    const glm::dvec3 d = glm::dvec3(q[1]) / scale;
    const double r = q[2].w;
    const double b = -glm::dot(f, d);
    ExactSphereHit hit;
    hit.passes = glm::length(glm::cross(f, d));
    const double half = std::sqrt(std::max(0.0, (r - hit.passes) * (r + hit.passes)));
    hit.cosine = half / r;
    if (hit.passes <= r)
        hit.t = (b - half > 0 ? b - half : b + half) / scale;
    return hit;
}

struct SphereErrors {
    double wrong = 0;  ///< Share of rays told hit for miss or the other way round.
    double off = 0;  ///< [ulp of the distance and radius], of clear hits, at normal incidence
};

SphereErrors sphere_errors(const std::vector<Query>& queries)
{
    SphereErrors errors;
    const std::vector<glm::vec4> found = intersect(kIntersectSphere, queries);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const ExactSphereHit exact = exact_sphere_hit(queries[i]);
        const double extent =
            glm::length(glm::dvec3(queries[i][0]) - glm::dvec3(queries[i][2])) + queries[i][2].w;
        const double r = queries[i][2].w;
        // Nearer to the rim than this, or to the surface, rounding decides.
        const double unit = kUlp * extent;
        if (std::abs(exact.passes - r) <= 4 * unit)
            continue;
        errors.wrong += (found[i].x > 0) == (exact.t > 0) ? 0 : 1;
        if (found[i].x > 0 && exact.t > 0)
            errors.off = farther(errors.off, std::abs(found[i].x - exact.t) * exact.cosine / unit);
    }
    errors.wrong /= static_cast<double>(queries.size());
    return errors;
}

/// Rays from `distance` that pass a sphere's middle by up to two radii.
std::vector<Query> rays_past_a_sphere(float distance, float radius, std::size_t count)
{
    std::mt19937 random(16);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<Query> queries;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = (distance + radius) * random_direction(random);
        const glm::vec3 aside = glm::normalize(glm::cross(origin, random_direction(random)));
        const glm::vec3 target = 2 * radius * uniform(random) * aside;
        queries.push_back({glm::vec4(origin, 0), glm::vec4(glm::normalize(target - origin), 0),
            glm::vec4(0, 0, 0, radius)});
    }
    return queries;
}

void far_and_large_spheres(Findings& findings, Length length)
{
    const std::size_t count = length == Length::kLong ? 300'000 : 20'000;
    for (const auto& [distance, radius] :
        {std::pair(1.0F, 1.0F), std::pair(1e3F, 1.0F), std::pair(1e4F, 1.0F), std::pair(1e5F, 1.0F),
            std::pair(1e6F, 1.0F), std::pair(2.0F, 1e6F), std::pair(1e-6F, 1e-6F)}) {
        const SphereErrors errors = sphere_errors(rays_past_a_sphere(distance, radius, count));
        char name[64];
        std::snprintf(name, sizeof name, "radius %g, %g away: ", radius, distance);
        findings.none(std::string(name) + "share told hit for miss or miss for hit", errors.wrong);
        findings.at_most(std::string(name) + "distance off [ulp]", errors.off, 8);
    }
}

/// From the middle, and from anywhere inside: the other side, its normal turned inwards.
void spheres_from_inside(Findings& findings, Length length)
{
    std::mt19937 random(17);
    std::uniform_real_distribution<float> uniform(0, 0.57F);  // 1 / sqrt(3): inside
    const std::size_t count = length == Length::kLong ? 300'000 : 20'000;
    for (const float radius : {1e-6F, 1.0F, 1e6F}) {
        std::vector<Query> queries;
        for (std::size_t i = 0; i < count; ++i) {
            const bool middle = i % 4 == 0;
            const glm::vec3 origin = middle
                ? glm::vec3(0)
                : radius * glm::vec3(uniform(random), uniform(random), uniform(random));
            queries.push_back({glm::vec4(origin, 0), glm::vec4(random_direction(random), 0),
                glm::vec4(0, 0, 0, radius)});
        }
        const std::vector<glm::vec4> found = intersect(kIntersectSphere, queries);
        std::size_t missed = 0;
        double off = 0;
        for (std::size_t i = 0; i < count; ++i) {
            missed += found[i].x > 0 ? 0 : 1;
            off = farther(
                off, std::abs(found[i].x - exact_sphere_hit(queries[i]).t) / (kUlp * 2.0 * radius));
        }
        char name[32];
        std::snprintf(name, sizeof name, "radius %g: ", radius);
        findings.none(std::string(name) + "rays that do not meet it", static_cast<double>(missed));
        findings.at_most(std::string(name) + "distance off [ulp]", off, 4);
    }
}

Scene ball_with_bumps()
{
    Scene ball;
    ball.materials.push_back({"white", glm::vec3(0.5F), glm::vec3(1), true});
    ball.images.push_back({"bumps", 2, 2,
        {{128, 128, 255, 255}, {160, 128, 240, 255}, {128, 160, 240, 255}, {100, 100, 240, 255}}});
    ball.materials[0].normal_texture.image = 0;
    ball.objects.push_back({"ball", 0, Sphere{glm::dvec3(0), 3}});
    return ball;
}

/// Looked at from its very middle straight up and down: the picture's middle ray ends at a pole.
void poles_are_finite(Findings& findings, Length /*length*/)
{
    constexpr Extent kOdd{17, 17};
    const DeviceScene scene(ball_with_bumps());
    for (const double way : {1.0, -1.0}) {
        RenderRequest request = linear_request(scene.scene, kOdd, {});
        request.camera = {{0, 0, 0}, {0, way, 0}, {0, 1, 0}, 60};
        View view(scene.shared);
        RenderedFrame frame;
        for (int i = 0; i < 4; ++i)
            frame = view.render(request);
        double dark = 0;
        for (const float value : values_of(frame.image))
            dark += value >= 1 && std::isfinite(value) ? 0 : 1;
        RenderRequest depth = request;
        depth.settings.view = DebugView::kDepth;
        depth.settings.antialiasing = false;
        View depths(scene.shared);
        const std::string name = way > 0 ? "up: " : "down: ";
        findings.none(name + "non-finite values", frame.bad_values.all());
        findings.none(name + "values below what it emits", dark);
        findings.at_most(name + "depth of the pole off [ulp]",
            std::abs(pixel(depths.render(depth).image, 8, 8).x / 3.0 - 1) / kUlp, 4);
    }
}

constexpr Case kPrecisionCases[] = {
    {"4", "precision", "tiny triangles far away", Layer::kFunction,
        "Of triangles of 1 m seen from a thousand kilometres the one aimed at is met.",
        tiny_triangles_far_away},
    {"5", "precision", "triangle hits are exact", Layer::kFunction,
        "Distance and barycentric weights of a hit are within 8 ulp of double precision, from as "
        "near and far as numbers go.",
        triangle_hits_are_exact},
    {"16", "precision", "far and large spheres", Layer::kFunction,
        "A sphere a million radii away is hit where it is and missed where it is not; so is one as "
        "large as that.",
        far_and_large_spheres},
    {"17", "precision", "spheres from inside", Layer::kFunction,
        "From inside a sphere, or its very middle, the far side is met where it is.",
        spheres_from_inside},
    {"17b", "precision", "poles are finite", Layer::kPicture,
        "A ball with a normal map, seen from its very middle, is there and finite up to its poles.",
        poles_are_finite},
};

constexpr Guard kPrecisionGuards[] = {
    {"longest_axis", "4 5", "geometry/ray.glsl",
        "t.axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;", "t.axis = 2;"},
    {"rejection_vector", "16", "geometry/ray.glsl",
        "const float discriminant = radius * radius - dot(rejection, rejection);",
        "const float discriminant = b * b - (dot(f, f) - radius * radius);"},
    {"far_side", "17 17b", "geometry/ray.glsl", "t_a > t_min ? t_a : t_b", "t_a"},
};

}  // namespace

Group precision_group()
{
    return {kPrecisionCases, kPrecisionGuards};
}

}  // namespace farlight::lab
