// Gathering corners from meshes and quads, in leaf order.
#include "server/scene/pack_geometry.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>

namespace farlight {
namespace {

using Uvs = std::array<glm::vec2, 3>;

/// log2 of the square root of a ratio of areas; a face without area on the image stays on level 0.
float log2_uv_per_metre(const std::array<glm::vec3, 3>& vertices, const Uvs& uv)
{
    const glm::dvec2 u(uv[1] - uv[0]);
    const glm::dvec2 v(uv[2] - uv[0]);
    const glm::dvec3 edge_u(vertices[1] - vertices[0]);
    const glm::dvec3 edge_v(vertices[2] - vertices[0]);
    const double ratio = std::abs(u.x * v.y - u.y * v.x) / glm::length(glm::cross(edge_u, edge_v));
    return static_cast<float>(0.5 * std::log2(std::max(ratio, 1e-30)));
}

/// The direction in which u grows, and on which side of it v does (Lengyel 2001, "Computing Tangent
/// Space Basis Vectors for an Arbitrary Mesh"); any direction where the uvs tell none.
glm::vec4 face_tangent(const std::array<glm::vec3, 3>& vertices, const Uvs& uv)
{
    const glm::vec3 edge_u = vertices[1] - vertices[0];
    const glm::vec3 edge_v = vertices[2] - vertices[0];
    const glm::vec2 u = uv[1] - uv[0];
    const glm::vec2 v = uv[2] - uv[0];
    const float area = u.x * v.y - u.y * v.x;
    const glm::vec3 along = (edge_u * v.y - edge_v * u.y) * (area < 0 ? -1.0F : 1.0F);
    // glTF's v points down an image, its bitangent up: w = +1 for a picture that is not mirrored.
    return {glm::length(along) > 0 ? glm::normalize(along) : glm::normalize(edge_u),
        area < 0 ? 1.0F : -1.0F};
}

/// A quad's halves: corner, + edge_u, opposite; corner, opposite, + edge_v. Mirrored: the edges
/// have changed places.
Uvs quad_uvs(std::uint32_t face, bool mirrored)
{
    const glm::vec2 at_u = mirrored ? glm::vec2(0, 0) : glm::vec2(1, 1);
    const glm::vec2 at_v = mirrored ? glm::vec2(1, 1) : glm::vec2(0, 0);
    return face == 0 ? Uvs{{{0, 1}, at_u, {1, 0}}} : Uvs{{{0, 1}, {1, 0}, at_v}};
}

Uvs uvs_of(const FlatObject& object, const FlatTriangle& triangle, int set)
{
    if (object.mesh == nullptr)
        return quad_uvs(triangle.face, object.mirrored);
    Uvs uv{};
    if (const auto& list = object.mesh->uvs[set]; !list.empty()) {
        const glm::uvec3 corners = corners_of(object, triangle.face);
        for (int k = 0; k < 3; ++k)
            uv[static_cast<std::size_t>(k)] = list[corners[k]];
    }
    return uv;
}

glm::uvec2 pack_color(const glm::vec4& color)
{
    return {glm::packHalf2x16({color.x, color.y}), glm::packHalf2x16({color.z, color.w})};
}

}  // namespace

glm::uvec4 pack_normals(const std::vector<glm::vec3>& normals, const glm::uvec3& corners,
    const glm::mat3& group_from_normal)
{
    glm::uvec4 packed(0, 0, 0, 1);
    for (int k = 0; k < 3; ++k)
        packed[k] = pack_octahedral(group_from_normal * normals[corners[k]]);
    return packed;
}

glm::uvec4 pack_tangents(const std::vector<glm::vec4>& tangents, const glm::uvec3& corners,
    const glm::mat3& group_from_mesh, bool mirrored)
{
    glm::uvec4 packed(0);
    for (int k = 0; k < 3; ++k) {
        const glm::vec4& tangent = tangents[corners[k]];
        packed[k] = pack_octahedral(group_from_mesh * glm::vec3(tangent));
        packed.w |= (tangent.w < 0) != mirrored ? 1U << k : 0U;
    }
    return packed;
}

std::uint32_t material_word(const Scene& scene, std::uint32_t object)
{
    const std::uint32_t material = scene.objects[object].material;
    const bool holes = scene.materials[material].alpha_mode != AlphaMode::kOpaque;
    return material | (holes ? MATERIAL_HAS_HOLES : 0);
}

GeometryPacker::GeometryPacker(
    const Scene& scene, const FlatScene& flat, const WantedAttributes& wanted)
    : scene_(scene)
    , flat_(flat)
    , wanted_(wanted)
{
    std::size_t triangles = 0;
    for (const FlatGroup& group : flat.groups)
        triangles += group.triangles.size();
    packed_.triangles.reserve(triangles * TRIANGLE_TEXELS);
}

void GeometryPacker::pack(const FlatGroup& group, std::span<const std::uint32_t> order)
{
    const std::size_t first_disk = group.triangles.size() + group.spheres.size();
    for (const std::uint32_t i : order) {
        if (i < group.triangles.size())
            pack_triangle(group.triangles[i]);
        else if (i < first_disk)
            pack_sphere(group.spheres[i - group.triangles.size()]);
        else
            pack_disk(group.disks[i - first_disk]);
    }
}

void GeometryPacker::pack_triangle(const FlatTriangle& triangle)
{
    const auto& [a, b, c] = triangle.vertices;
    packed_.triangles.push_back(texel(a, triangle.object));
    packed_.triangles.push_back(texel(b, material_word(scene_, triangle.object)));
    packed_.triangles.push_back(texel(c, triangle.light));
    pack_attributes(triangle);
}

void GeometryPacker::pack_attributes(const FlatTriangle& triangle)
{
    const FlatObject& object = flat_.objects[triangle.object];
    const glm::uvec3 corners =
        object.mesh == nullptr ? glm::uvec3(0) : corners_of(object, triangle.face);
    const auto has = [&](const auto list) {
        return object.mesh != nullptr && !(object.mesh->*list).empty();
    };
    if (wanted_.normals)
        packed_.normals.push_back(!has(&Mesh::normals)
                ? glm::uvec4(0)
                : pack_normals(object.mesh->normals, corners, object.group_from_normal));
    for (int set = 0; set < 2; ++set)
        if (wanted_.uvs[set]) {
            const Uvs uv = uvs_of(object, triangle, set);
            packed_.uvs[set].emplace_back(
                bits(uv[0].x), bits(uv[0].y), bits(uv[1].x), bits(uv[1].y));
            packed_.uvs[set].emplace_back(
                bits(uv[2].x), bits(uv[2].y), bits(log2_uv_per_metre(triangle.vertices, uv)), 0);
        }
    if (wanted_.tangents && has(&Mesh::tangents)) {
        packed_.tangents.push_back(pack_tangents(
            object.mesh->tangents, corners, glm::mat3(object.group_from_mesh), object.mirrored));
    } else if (wanted_.tangents) {
        const int set =
            scene_.materials[scene_.objects[triangle.object].material].normal_texture.uv_set;
        const glm::vec4 tangent = face_tangent(triangle.vertices, uvs_of(object, triangle, set));
        packed_.tangents.emplace_back(
            glm::uvec3(pack_octahedral(glm::vec3(tangent))), tangent.w < 0 ? 7U : 0U);
    }
    if (wanted_.colors) {
        const auto color = [&](int k) {
            return pack_color(has(&Mesh::colors) ? object.mesh->colors[corners[k]] : glm::vec4(1));
        };
        packed_.colors.emplace_back(color(0), color(1));
        packed_.colors.emplace_back(color(2), glm::uvec2(0));
    }
}

void GeometryPacker::pack_sphere(const FlatSphere& sphere)
{
    packed_.spheres.push_back(texel(sphere.center, bits(sphere.radius)));
    packed_.spheres.emplace_back(
        sphere.object, material_word(scene_, sphere.object), sphere.light, 0);
}

void GeometryPacker::pack_disk(const FlatDisk& disk)
{
    packed_.disks.push_back(texel(disk.center, bits(disk.radius)));
    packed_.disks.push_back(texel(disk.normal, 0));
    packed_.disks.emplace_back(disk.object, material_word(scene_, disk.object), disk.light, 0);
}

}  // namespace farlight
