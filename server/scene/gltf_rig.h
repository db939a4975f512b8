// Which nodes of a glTF scene move or are joints, and so become Animation::nodes.
#pragma once

#include "server/scene/gltf_node.h"

#include <set>

namespace farlight {

class GltfRig {
public:
    /// What is carried by the nodes that are kept.
    enum class Carried : std::uint8_t { kObjectsAndLights, kCameras };

    /// Fills the tree's carriers and animation.nodes. Throws SceneError for skins whose joints are
    /// not in the scene.
    GltfRig(const GltfContainer& gltf, GltfTree& tree, Animation& animation,
        Carried carried = Carried::kObjectsAndLights);

    /// Index into Animation::nodes of the document's node; kNone: it rests, or nothing hangs on it.
    std::uint32_t node(std::size_t index) const;

    /// Whether an animation moves the node or one above it.
    bool moves(const GltfNode& node) const;

    /// Index into Animation::skins of the document's skin, read when first asked for; `place` names
    /// it. Throws SceneError.
    std::uint32_t skin(const nlohmann::json& index, const ScenePlace& place);

private:
    void find_moving();
    void find_joints();
    void find_carrying();
    bool carries(const nlohmann::json& node) const;
    void place_nodes();
    std::vector<glm::dmat4> inverse_binds(
        const nlohmann::json& skin, const ScenePlace& place) const;

    const GltfContainer& gltf_;
    GltfTree& tree_;
    Animation& animation_;
    Carried carried_;
    // By place in the tree:
    std::vector<bool> moves_;  // itself
    std::vector<bool> is_moved_;  // or by what is above it
    std::vector<bool> is_joint_;
    std::vector<bool> carries_;  // something hangs on it or below it
    std::vector<std::uint32_t> nodes_;
    std::map<std::size_t, std::uint32_t> skins_;
};

}  // namespace farlight
