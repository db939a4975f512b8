// The node tree of a glTF scene, flattened.
#pragma once

#include "server/scene/gltf_container.h"

#include <glm/glm.hpp>
#include <vector>

namespace farlight {

struct GltfNode {
    std::size_t index = 0;  ///< Into the document's nodes.
    glm::dmat4 world_from_node{1};
};

/// Every node under the scene's roots, parents first. Throws SceneError for a node that is reached
/// twice (a cycle, or two parents) and for a transform that is not finite.
std::vector<GltfNode> gltf_nodes(const GltfContainer& gltf, std::size_t scene);

}  // namespace farlight
