// Source: Lengyel 2001, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", weighted by
// the corners' angles (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 3.3).
#include "server/scene/mesh_tangents.h"

#include "server/scene/mesh_vertices.h"

#include <cmath>

namespace farlight {

namespace {

/// How uv runs over a triangle.
struct UvFrame {
    glm::dvec3 tangent{0};  ///< Unit, towards larger u; zero where uv has no area.
    bool mirrored = false;  ///< The picture is seen from its back: w = -1.
};

UvFrame uv_frame(const Mesh& mesh, const std::vector<glm::vec2>& uvs, const glm::uvec3& triangle)
{
    const glm::dvec3 a = mesh.positions[triangle.x];
    const glm::dvec3 edge1 = glm::dvec3(mesh.positions[triangle.y]) - a;
    const glm::dvec3 edge2 = glm::dvec3(mesh.positions[triangle.z]) - a;
    const glm::dvec2 uv = uvs[triangle.x];
    const glm::dvec2 uv1 = glm::dvec2(uvs[triangle.y]) - uv;
    const glm::dvec2 uv2 = glm::dvec2(uvs[triangle.z]) - uv;
    const double area = uv1.x * uv2.y - uv1.y * uv2.x;
    const glm::dvec3 along_u = (edge1 * uv2.y - edge2 * uv1.y) * (area < 0 ? -1.0 : 1.0);
    const double length = glm::length(along_u);
    if (area == 0 || !(length > 0))
        return {};
    // v grows downwards in the picture and a normal map's green upwards: on a triangle that shows
    // the picture as it is, area < 0. Shading normals that oppose the winding turn that about.
    const bool opposed = !mesh.normals.empty()
        && glm::dot(glm::dvec3(mesh.normals[triangle.x]), glm::cross(edge1, edge2)) < 0;
    return {along_u / length, (area > 0) != opposed};
}

double corner_angle(const Mesh& mesh, const glm::uvec3& triangle, int corner)
{
    const glm::dvec3 at = mesh.positions[triangle[corner]];
    const glm::dvec3 u = glm::dvec3(mesh.positions[triangle[(corner + 1) % 3]]) - at;
    const glm::dvec3 v = glm::dvec3(mesh.positions[triangle[(corner + 2) % 3]]) - at;
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

/// A unit vector orthogonal to `normal`, which is unit or zero.
glm::dvec3 any_tangent(const glm::dvec3& normal)
{
    if (normal == glm::dvec3(0))
        return {1, 0, 0};
    const glm::dvec3 away =
        std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);  // 0.6 > 1 / sqrt(3)
    return glm::normalize(glm::cross(normal, away));
}

/// The sum's direction across the normal; nothing left of it: any.
glm::dvec3 across_normal(const glm::dvec3& sum, const glm::dvec3& normal)
{
    const glm::dvec3 across = sum - glm::dot(sum, normal) * normal;
    const double length = glm::length(across);
    // Less than 1e-7 of the sum is the rounding of a float normal.
    return length > 1e-7 * glm::length(sum) ? across / length : any_tangent(normal);
}

}  // namespace

const Texture* normal_map(const Material& material)
{
    if (material.normal_texture.used())
        return &material.normal_texture;
    return material.clearcoat_normal_texture.used() ? &material.clearcoat_normal_texture : nullptr;
}

void add_tangents(Mesh& mesh, std::uint8_t uv_set)
{
    if (mesh.uvs[uv_set].empty())
        return;
    mesh.tangents.clear();
    std::vector<UvFrame> frames;
    frames.reserve(mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles)
        frames.push_back(uv_frame(mesh, mesh.uvs[uv_set], triangle));
    split_vertices(mesh, [&](std::size_t triangle) { return frames[triangle].mirrored; });

    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0));
    std::vector<double> signs(mesh.positions.size(), 1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh.triangles[i][corner];
            sums[vertex] += frames[i].tangent * corner_angle(mesh, mesh.triangles[i], corner);
            if (frames[i].mirrored)
                signs[vertex] = -1;
        }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const glm::dvec3 normal =
            mesh.normals.empty() ? glm::dvec3(0) : glm::dvec3(mesh.normals[i]);
        mesh.tangents.emplace_back(across_normal(sums[i], normal), signs[i]);
    }
}

}  // namespace farlight
