// From posed vertices to texels.
#include "server/scene/deforming_mesh.h"

#include "server/scene/pack_geometry.h"
#include "shaders/shared/scene_layout.h"

namespace farlight {
namespace {

glm::vec3 vertex(const Texels& triangles, std::size_t triangle, std::size_t k)
{
    return glm::uintBitsToFloat(glm::uvec3(triangles[triangle * TRIANGLE_TEXELS + k]));
}

}  // namespace

DeformingMesh::DeformingMesh(const FlatScene& flat, const FlatGroup& group,
    std::span<const std::uint32_t> order, std::uint32_t first, const TreePlace& tree)
    : object_(group.triangles.front().object)
    , first_(first)
    , tree_(tree)
    , mirrored_(flat.objects[object_].mirrored)
{
    for (const std::uint32_t i : order) {
        corners_.push_back(corners_of(flat.objects[object_], group.triangles[i].face));
        lights_.push_back(group.triangles[i].light);
    }
}

void DeformingMesh::pack(const VertexPose& pose, DeformingTables& tables) const
{
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const std::size_t triangle = first_ + i;
        for (std::size_t k = 0; k < 3; ++k) {
            glm::uvec4& target = tables.triangles[triangle * TRIANGLE_TEXELS + k];
            target = texel(pose.positions[corners_[i][static_cast<int>(k)]], target.w);
        }
        if (!tables.normals.empty() && !pose.normals.empty())
            tables.normals[triangle] = pack_normals(pose.normals, corners_[i], glm::mat3(1));
        if (!tables.tangents.empty() && !pose.tangents.empty())
            tables.tangents[triangle] =
                pack_tangents(pose.tangents, corners_[i], glm::mat3(1), mirrored_);
    }
    const auto bounds_of_leaf = [&](std::uint32_t word) {
        const std::size_t first = (word & BVH_FIRST_MASK) - tables.first_triangle;
        const std::size_t count = ((word >> BVH_COUNT_SHIFT) & 3U) + 1;
        PrimitiveBounds bounds{
            vertex(tables.triangles, first, 0), vertex(tables.triangles, first, 0)};
        for (std::size_t i = first; i < first + count; ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                bounds.lower = glm::min(bounds.lower, vertex(tables.triangles, i, k));
                bounds.upper = glm::max(bounds.upper, vertex(tables.triangles, i, k));
            }
        return bounds;
    };
    refit(tables.bvh_nodes, tables.first_node, tree_.root, tree_.end, bounds_of_leaf);
}

void DeformingMesh::pack_previous(const VertexPose& pose, DeformingTables& tables) const
{
    for (std::size_t i = 0; i < corners_.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            tables.prev_vertices[PREV_VERTEX_HEADER + (first_ + i) * TRIANGLE_TEXELS + k] =
                texel(pose.positions[corners_[i][static_cast<int>(k)]], 0);
}

void DeformingMesh::move_lights(const VertexPose& pose, std::vector<Light>& lights) const
{
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        if (lights_[i] == 0)
            continue;
        const glm::vec3& a = pose.positions[corners_[i].x];
        const glm::vec3& b = pose.positions[corners_[i].y];
        const glm::vec3& c = pose.positions[corners_[i].z];
        const Light shape = light_of_triangle(a, b - a, c - a);
        Light& light = lights[lights_[i] - 1];
        light.p0 = shape.p0, light.edge_u = shape.edge_u, light.edge_v = shape.edge_v;
        light.area = shape.area;
    }
}

}  // namespace farlight
