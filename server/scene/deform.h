// Vertices of a mesh that changes its shape: morph targets first, then the skin.
#pragma once

#include "server/scene/scene.h"

#include <span>

namespace farlight {

/// What a mesh's vertices are at one time; a list the mesh lacks stays empty.
struct VertexPose {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< Unit.
    std::vector<glm::vec4> tangents;
};

/// Whether joints carry the object's vertices; its own node then does not (glTF).
bool is_skinned(const Scene& scene, const Object& object);

/// Whether the object's shape follows from more than its transform: a skin, or morph targets.
bool has_pose(const Scene& scene, const Object& object);

/// Whether that shape changes with time. `moving`: moving_nodes().
bool changes_shape(const Scene& scene, std::uint32_t object, const std::vector<bool>& moving);

/// Gives every object whose morph weights no track drives a mesh of the vertices that it has, so
/// that it moves rigidly, if at all. Meshes that nothing shows any longer become empty.
void settle_morphs(Scene& scene);

/// world_from_mesh of each joint.
std::vector<glm::mat4> skin_matrices(const Skin& skin, std::span<const glm::dmat4> world_from_node);

/// Morphs by `weights`, then, with `joints`, skins to world space: the blend of the joints'
/// matrices (linear blend skinning, as glTF has it). Without joints, `world_from_mesh` applies.
VertexPose pose_vertices(const Mesh& mesh, std::span<const float> weights,
    std::span<const glm::mat4> joints, const glm::dmat4& world_from_mesh);

/// The object's vertices in world space at `time`, whether it moves or not. It must have a mesh.
/// `origin`: of the space that `world_from_node` leads to, in the scene's coordinates.
VertexPose pose_object(const Scene& scene, std::uint32_t object, double time,
    std::span<const glm::dmat4> world_from_node, const glm::dvec3& origin = glm::dvec3(0));

/// world_from_object of a shape carried by `node`.
inline glm::dmat4 carried(
    std::uint32_t node, std::span<const glm::dmat4> world_from_node, const glm::dmat4& local)
{
    return node == kNone ? local : world_from_node[node] * local;
}

}  // namespace farlight
