// The node tree of a glTF scene, flattened.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/scene.h"

#include <vector>

namespace farlight {

struct GltfNode {
    std::size_t index = 0;  ///< Into the document's nodes.
    std::uint32_t parent = kNone;  ///< Into GltfTree::nodes.
    /// parent_from_node: either a matrix (`local`), or translation * rotation * scale.
    Node transform;
    glm::dmat4 parent_from_node{1};
    glm::dmat4 world_from_node{1};  ///< At rest.

    std::uint32_t carrier = kNone;  ///< Into Animation::nodes: what moves this node, if anything.
    glm::dmat4 carrier_from_node{1};  ///< Without a carrier: world_from_node.
};

struct GltfTree {
    std::vector<GltfNode> nodes;  ///< All under the scene's roots, parents first; no carriers yet.
    std::size_t changed_rotations = 0;  ///< Quaternions brought to unit length.

    /// The place in `nodes` of the document's node `index`; kNone: not in the scene.
    std::uint32_t find(std::size_t index) const;

    std::vector<std::uint32_t> places;  ///< By the document's node.
};

/// Throws SceneError for a node that is reached twice (a cycle, or two parents) and for a transform
/// that is not finite.
GltfTree read_gltf_tree(const GltfContainer& gltf, std::size_t scene);

/// How far from 1 a quaternion's length may be by rounding alone: half a step of a byte a
/// component.
inline constexpr double kRoundedRotation = 0.01;

}  // namespace farlight
