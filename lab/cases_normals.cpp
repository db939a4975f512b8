// Shading normals that lean too far, point inwards or are told by a map that says nothing.
//
// Seeds are fixed. Means are bounded by 5 standard errors, which a fresh seed would pass once
// in 1.7 million.
#include "lab/evaluate.h"
#include "lab/groups.h"
#include "lab/lossless_materials.h"
#include "lab/meshes.h"
#include "lab/rendering.h"
#include "lab/statistics.h"

#include <cmath>
#include <numbers>
#include <random>

namespace farlight::lab {
namespace {

constexpr const char* kNormalMapHead = R"(
#define BVH_STACK_SIZE 4
#define FX_TRIANGLES 1
#define FX_TEXTURES 1
#define TEXTURE_ARRAY_COUNT 1
#define FX_NORMAL_MAPS 1
#include "lib/random.glsl"
#include "materials/normal_map.glsl"
vec3 anywhere(uint row, uint which)
{
    return sample_cone(random4(uvec2(row, which), 42u, 0u, 0u, 0u).xy, 2.0);
}
)";

/// Every texel with every tangent and place of the viewer; x counts normals that are none, y those
/// below the surface, z those that do not see the viewer, w is how far a flat texel turns its
/// normal.
constexpr const char* kNormalMaps = R"(
    const float nan = uintBitsToFloat(0x7fc00000u), infinity = uintBitsToFloat(0x7f800000u);
    const vec3 texels[8] = vec3[](vec3(0.5), vec3(0.0), vec3(0.5, 0.5, 0.0), vec3(1.0, 0.5, 0.5), vec3(0.50196078),
        vec3(0.5, 0.5, 1.0), random4(uvec2(row, 7u), 1u, 0u, 0u, 0u).xyz, vec3(0.49, 0.5, 0.4));
    const vec3 geometric = anywhere(row, 0u);
    const vec3 lean = anywhere(row, 1u);
    const vec3 smooth_normal = row % 3u == 0u ? geometric : normalize(lean * (dot(lean, geometric) < 0.0 ? -1.0 : 1.0));
    const vec3 tangents[8] = vec3[](vec3(0.0), geometric, smooth_normal, vec3(nan), vec3(1e-30), vec3(infinity, 0.0, 0.0),
        vec3(1e-42, 0.0, 0.0), anywhere(row, 2u));
    const float heights[5] = float[](1.0, 0.3, 1e-3, 1e-7, 0.0);
    const float height = heights[x_bits.z % 5u];
    const vec3 along = normalize(cross(geometric, anywhere(row, 3u)));
    const vec3 wo = normalize(height * geometric + sqrt(1.0 - height * height) * along);
    const float scale = x_bits.w == 0u ? 1.0 : x_bits.w == 1u ? 1e-30 : 30.0;
    Surface s;
    s.front = row % 2u == 0u;
    s.geometric_normal = geometric;
    s.shading_normal = smooth_normal;
    s.tangent = vec4(tangents[x_bits.y % 8u], row % 5u == 0u ? -1.0 : 1.0);
    const vec3 mapped = mapped_normal(s, decoded_normal(texels[x_bits.x % 8u], scale));
    const vec3 bent = bent_normal(mapped, geometric, wo);
    const bool unit = abs(length(mapped) - 1.0) <= 1e-5 && abs(length(bent) - 1.0) <= 1e-5;
    result.x = all_finite(mapped) && all_finite(bent) && unit ? 0.0 : 1.0;
    const float least = height > 1e-6 ? 1e-9 : -2e-4;  // on the horizon, up to rounding of 1e-3
    result.y = dot(bent, geometric) >= least ? 0.0 : 1.0;
    result.z = dot(bent, wo) >= least ? 0.0 : 1.0;
    result.w = x_bits.x % 8u == 5u ? length(mapped - smooth_normal) : 0.0;
)";

void normal_maps_at_their_limits(Findings& findings, Length length)
{
    std::vector<glm::uvec4> rows;
    for (int turn = 0; turn < (length == Length::kLong ? 200 : 10); ++turn)
        for (std::uint32_t texel = 0; texel < 8; ++texel)
            for (std::uint32_t tangent = 0; tangent < 8; ++tangent)
                for (std::uint32_t height = 0; height < 5; ++height)
                    for (std::uint32_t scale = 0; scale < 3; ++scale)
                        rows.emplace_back(texel, tangent, height, scale);
    double none = 0;
    double below = 0;
    double blind = 0;
    double turned = 0;
    for (const glm::vec4& r : evaluate({kNormalMapHead, kNormalMaps, {}}, rows)) {
        none += static_cast<double>(r.x);
        below += static_cast<double>(r.y);
        blind += static_cast<double>(r.z);
        turned = farther(turned, static_cast<double>(r.w));
    }
    findings.none("normals that are not finite or not unit", none);
    findings.none("normals below the surface", below);
    findings.none("normals that face away from the viewer", blind);
    findings.at_most("what a flat texel turns a normal by", turned, 1e-6);
}

/// Normals all over the sphere, the lower half of it too.
Image8 wild_normals(float lowest)
{
    Image8 image{"normals", 16, 16, {}};
    std::mt19937 random(5);
    std::uniform_real_distribution<float> turn(0, 2 * std::numbers::pi_v<float>);
    std::uniform_real_distribution<float> height(lowest, 1);
    for (int i = 0; i < 16 * 16; ++i) {
        const float z = height(random);
        const float phi = turn(random);
        const float r = std::sqrt(1 - z * z);
        const glm::vec3 n(r * std::cos(phi), r * std::sin(phi), z);
        image.texels.emplace_back(glm::u8vec3(glm::round((n * 0.5F + 0.5F) * 255.0F)), 255);
    }
    image.texels[7] = {128, 128, 128, 255};
    image.texels[8] = {0, 0, 0, 255};
    return image;
}

Scene under_a_white_sky()
{
    Scene scene;
    scene.background = glm::vec3(1);
    scene.camera = {{0, 1.2, 3}, {0, 0, 0}, {0, 1, 0}, 45};
    return scene;
}

/// Slanted squares side by side whose normal maps send light everywhere.
Scene reliefs(float lowest)
{
    Scene scene = under_a_white_sky();
    scene.images.push_back(wild_normals(lowest));
    double left = -2;
    for (Material material : {lossless::white(0, 1), lossless::white(1, 0.5F),
             lossless::white(1, 0), lossless::plastic(0.4F), lossless::thin_glass(0.4F)}) {
        material.normal_texture.image = 0;
        scene.objects.push_back({"relief", static_cast<std::uint32_t>(scene.materials.size()),
            Quad{{left, -0.3, 1}, {0.75, 0, 0}, {0, 0.6, -2}}});
        scene.materials.push_back(std::move(material));
        left += 0.8;
    }
    return scene;
}

/// A bumpy ball whose normals are those of a ball, or point anywhere, inwards too, no two alike.
Mesh bumps(const glm::vec3& center, bool random_normals)
{
    Mesh mesh = bumpy_sphere(24, 12, center);
    std::mt19937 random(43);
    std::normal_distribution<float> normal;
    for (const glm::vec3& position : mesh.positions)
        mesh.normals.push_back(glm::normalize(random_normals
                ? glm::vec3(normal(random), normal(random), normal(random))
                : position - center));
    // Opposite at the corners of a triangle: somewhere between them there is no normal.
    if (random_normals)
        mesh.normals[mesh.triangles[30].y] = -mesh.normals[mesh.triangles[30].x];
    return mesh;
}

Scene balls_with_bumps(bool random_normals)
{
    Scene scene = under_a_white_sky();
    scene.materials = {lossless::white(0, 1), lossless::white(1, 0.3F), lossless::plastic(0.4F),
        lossless::glass(0)};
    for (std::uint32_t i = 0; i < 4; ++i) {
        scene.meshes.push_back(
            bumps({i % 2 == 0 ? -1.3F : 1.3F, i < 2 ? 1.3F : -1.3F, -2}, random_normals));
        scene.objects.push_back({"ball", i, MeshInstance{i}});
    }
    return scene;
}

/// How far the mean of a white scene is from the sky's 1, past 5 standard errors.
void report_furnace(
    Findings& findings, const std::string& which, const Scene& scene, double tolerance)
{
    const Estimate mean = mean_of(rendered(scene, averaged(8, true, 48)));
    const double noise = 5 * mean.standard_error;
    findings.at_most(which + ": mean beyond the sky's 1, past 5 standard errors",
        mean.mean - noise - 1, tolerance);
    findings.at_most(
        which + ": mean below it, past 5 standard errors", 1 - mean.mean - noise, tolerance);
    findings.at_most(which + ": standard error", mean.standard_error, 2e-3);
}

void reliefs_lose_nothing(Findings& findings, Length length)
{
    report_furnace(findings, "anywhere", reliefs(-1), 2e-3);  // the tables of albedo
    if (length == Length::kLong)
        report_furnace(findings, "17 degrees above the surface", reliefs(0.3F), 2e-3);
}

void random_normals_lose_nothing(Findings& findings, Length /*length*/)
{
    // And what is left in glass after 48 bounces.
    report_furnace(findings, "a ball's normals", balls_with_bumps(false), 4e-3);
    report_furnace(findings, "random normals", balls_with_bumps(true), 4e-3);
}

void flat_map_is_none(Findings& findings, Length /*length*/)
{
    Scene with = scene_of(bumps(glm::vec3(0), false));
    with.background = glm::vec3(1);
    with.materials[0] = lossless::plastic(0.3F);
    with.materials[0].albedo = glm::vec3(0.5F, 0.7F, 0.2F);
    const Rendering how = averaged(4, true, 6);
    const Image without = rendered(with, how);
    with.images.push_back({"flat", 2, 2, std::vector<glm::u8vec4>(4, {128, 128, 255, 255})});
    with.materials[0].normal_texture.image = 0;
    with.meshes[0].uvs[0].assign(with.meshes[0].positions.size(), {0, 0});
    findings.none("values that a flat map changes", values_unlike(rendered(with, how), without));
}

constexpr Case kNormalsCases[] = {
    {"42", "normals", "normal maps at their limits", Layer::kFunction,
        "Whatever the texel, the tangent and the viewer, a mapped normal is unit, above the "
        "surface and "
        "faces the viewer.",
        normal_maps_at_their_limits},
    {"42b", "normals", "a flat normal map", Layer::kPicture, "A flat normal map changes no bit.",
        flat_map_is_none},
    {"43", "normals", "normal maps lose nothing", Layer::kPicture,
        "White squares with normal maps that point everywhere, down too, cannot be seen under a "
        "white "
        "sky.",
        reliefs_lose_nothing},
    {"43b", "normals", "random shading normals lose nothing", Layer::kPicture,
        "Nor can white things with shading normals at random, inwards too.",
        random_normals_lose_nothing},
};

constexpr Guard kNormalsGuards[] = {
    {"texel_without_direction", "42", "materials/normal_map.glsl",
        "return dot(n, n) > 0.0 ? n : vec3(0.0, 0.0, 1.0);", "return n;"},
    {"tangent_without_direction", "42", "materials/normal_map.glsl",
        "dot(along, along) > 0.0 ? normalize(along) : basis_around(normal)[0];",
        "normalize(along);"},
    {"normals_turned_up", "42", "materials/normal_map.glsl",
        "lean < 0.0 ? n - 2.0 * lean * geometric_normal : n;", "n;"},
    {"mirrored_to_the_horizon", "42", "materials/normal_map.glsl",
        "dot(half_way, half_way) > 1e-6 ? normalize(half_way) : geometric_normal;",
        "normalize(half_way);"},
    {"seen_by_the_viewer", "42", "materials/normal_map.glsl",
        "height >= least && dot(upright, wo) > 0.0 ?", "height >= least ?"},
    {"flat_normal_map_is_none", "42b"},
    {"mirrored_at_the_surface", "43 43b", "bsdf/bsdf.glsl",
        "if (!lost && (height > 0.0) == s.transmitted)", "if (false)"},
};

}  // namespace

Group normals_group()
{
    return {kNormalsCases, kNormalsGuards};
}

}  // namespace farlight::lab
