// DeformingMesh: one object's triangles in leaf order, repacked and its tree refitted as they move.
#pragma once

#include "server/scene/bvh.h"
#include "server/scene/deform.h"
#include "server/scene/flatten.h"
#include "server/scene/texels.h"

namespace farlight {

/// A tree within bvh_nodes [texels].
struct TreePlace {
    std::uint32_t root = 0;
    std::uint32_t end = 0;
    int stack_depth = 0;
};

/// The tails of the tables that deforming objects fill: what stands there changes with time.
struct DeformingTables {
    std::uint32_t first_node = 0;  ///< Texel in bvh_nodes where `bvh_nodes` starts.
    std::uint32_t first_triangle = 0;  ///< Likewise, in triangles.
    Texels bvh_nodes;
    Texels triangles;
    Texels normals;  ///< Empty without FX_SHADING_NORMALS.
    Texels tangents;  ///< Empty without FX_NORMAL_MAPS.
    Texels prev_vertices;  ///< The whole table.
};

class DeformingMesh {
public:
    /// `order`: the tree's leaf order over the triangles of `group`, which fill the tables from
    /// triangle `first` on.
    DeformingMesh(const FlatScene& flat, const FlatGroup& group,
        std::span<const std::uint32_t> order, std::uint32_t first, const TreePlace& tree);

    std::uint32_t object() const { return object_; }
    const TreePlace& tree() const { return tree_; }

    /// Writes vertices, normals and tangents, and refits the tree.
    void pack(const VertexPose& pose, DeformingTables& tables) const;
    void pack_previous(const VertexPose& pose, DeformingTables& tables) const;
    void move_lights(const VertexPose& pose, std::vector<Light>& lights) const;

private:
    std::uint32_t object_;
    std::uint32_t first_;
    TreePlace tree_;
    bool mirrored_;
    std::vector<glm::uvec3> corners_;  ///< Of each triangle.
    std::vector<std::uint32_t> lights_;  ///< Of each triangle: index + 1, 0: none.
};

}  // namespace farlight
