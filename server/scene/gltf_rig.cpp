// Nodes at rest are folded into what they hang on. Reference: glTF 2.0 specification, 3.7.3
// "Skins".
#include "server/scene/gltf_rig.h"

#include "server/scene/gltf_accessor.h"
#include "server/scene/gltf_component.h"

#include <cmath>

namespace farlight {

namespace {

using Json = nlohmann::json;

const Json* skin_of(const GltfContainer& gltf, const Json& node)
{
    return node.contains("mesh") && node.contains("skin")
        ? &gltf.list("skins")[node["skin"].get<std::size_t>()]
        : nullptr;
}

bool finite(const glm::mat4& matrix)
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(matrix[column][row]))
                return false;
    return true;
}

}  // namespace

GltfRig::GltfRig(const GltfContainer& gltf, GltfTree& tree, Animation& animation, Carried carried)
    : gltf_(gltf)
    , tree_(tree)
    , animation_(animation)
    , carried_(carried)
    , moves_(tree.nodes.size(), false)
    , is_moved_(tree.nodes.size(), false)
    , is_joint_(tree.nodes.size(), false)
    , carries_(tree.nodes.size(), false)
    , nodes_(tree.nodes.size(), kNone)
{
    find_moving();
    if (carried == Carried::kObjectsAndLights)
        find_joints();
    find_carrying();
    place_nodes();
}

void GltfRig::find_moving()
{
    const Json& animations = gltf_.list("animations");
    for (std::size_t i = 0; i < animations.size(); ++i) {
        const Json& channels = animations[i]["channels"];
        for (std::size_t j = 0; j < channels.size(); ++j) {
            const Json& target = channels[j]["target"];
            const auto path = target["path"].get<std::string>();
            if (!target.contains("node")
                || (path != "translation" && path != "rotation" && path != "scale"))
                continue;
            const ScenePlace place =
                gltf_.root / "animations" / i / "channels" / j / "target" / "node";
            const Json& node = gltf_.item("nodes", target["node"], place);
            if (node.contains("matrix"))
                refuse(place, "a node with a matrix", "a node with translation, rotation, scale");
            const std::uint32_t here = tree_.find(target["node"].get<std::size_t>());
            if (here != kNone)
                moves_[here] = true;
        }
    }
}

void GltfRig::find_joints()
{
    for (const GltfNode& node : tree_.nodes) {
        const Json& json = gltf_.list("nodes")[node.index];
        const Json* skin = skin_of(gltf_, json);
        if (skin == nullptr)
            continue;
        const ScenePlace place = gltf_.root / "skins" / json["skin"].get<std::size_t>() / "joints";
        const Json& joints = (*skin)["joints"];
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const std::uint32_t here = tree_.find(joints[i].get<std::size_t>());
            if (here == kNone)
                refuse(place / i, "node " + joints[i].dump() + ", which is not in the scene",
                    "a node of the scene");
            is_joint_[here] = true;
        }
    }
}

bool GltfRig::carries(const Json& node) const
{
    if (carried_ == Carried::kCameras)
        return node.contains("camera");
    return (node.contains("mesh") && skin_of(gltf_, node) == nullptr)
        || gltf_extension(node, "KHR_lights_punctual") != nullptr;
}

void GltfRig::find_carrying()
{
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {  // children before their parents
        const GltfNode& node = tree_.nodes[i];
        const Json& json = gltf_.list("nodes")[node.index];
        if (is_joint_[i] || carries(json))
            carries_[i] = true;
        if (carries_[i] && node.parent != kNone)
            carries_[node.parent] = true;
    }
}

void GltfRig::place_nodes()
{
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
        GltfNode& node = tree_.nodes[i];
        glm::dmat4 carrier_from_parent(1);
        is_moved_[i] = moves_[i] || (node.parent != kNone && is_moved_[node.parent]);
        if (node.parent != kNone) {
            node.carrier = tree_.nodes[node.parent].carrier;
            carrier_from_parent = tree_.nodes[node.parent].carrier_from_node;
        }
        node.carrier_from_node = carrier_from_parent * node.parent_from_node;
        if (!((moves_[i] || is_joint_[i]) && carries_[i]))
            continue;
        Node kept = node.transform;
        kept.parent = node.carrier;
        kept.local = carrier_from_parent * kept.local;
        nodes_[i] = static_cast<std::uint32_t>(animation_.nodes.size());
        animation_.nodes.push_back(std::move(kept));
        node.carrier = nodes_[i];
        node.carrier_from_node = glm::dmat4(1);
    }
}

std::uint32_t GltfRig::node(std::size_t index) const
{
    const std::uint32_t here = tree_.find(index);
    return here == kNone ? kNone : nodes_[here];
}

bool GltfRig::moves(const GltfNode& node) const
{
    return is_moved_[tree_.find(node.index)];
}

std::vector<glm::dmat4> GltfRig::inverse_binds(const Json& skin, const ScenePlace& place) const
{
    const std::size_t joints = skin["joints"].size();
    if (!skin.contains("inverseBindMatrices"))
        return std::vector<glm::dmat4>(joints, glm::dmat4(1));
    const Json& index = skin["inverseBindMatrices"];
    const ScenePlace here = place / "inverseBindMatrices";
    const Json& accessor = gltf_.item("accessors", index, here);
    if (accessor["type"] != "MAT4" || accessor["componentType"] != kFloat)
        refuse(here,
            accessor["type"].get<std::string>() + " of component type "
                + accessor["componentType"].dump(),
            "MAT4 of floats");
    if (accessor["count"].get<std::size_t>() < joints)
        refuse(
            here, accessor["count"].dump() + " matrices", std::to_string(joints) + ", one a joint");
    std::vector<glm::dmat4> binds;
    for (const glm::mat4& matrix : read_accessor<glm::mat4>(gltf_, index)) {
        if (!finite(matrix))
            refuse(here, "a number that is not finite", "finite matrices");
        if (binds.size() < joints)
            binds.emplace_back(matrix);
    }
    return binds;
}

std::uint32_t GltfRig::skin(const Json& index, const ScenePlace& place)
{
    const Json& json = gltf_.item("skins", index, place);
    const auto [known, is_new] = skins_.try_emplace(
        index.get<std::size_t>(), static_cast<std::uint32_t>(animation_.skins.size()));
    if (!is_new)
        return known->second;
    Skin skin;
    for (const Json& joint : json["joints"])
        skin.joints.push_back(node(joint.get<std::size_t>()));
    skin.joint_from_mesh = inverse_binds(json, gltf_.root / "skins" / index.get<std::size_t>());
    animation_.skins.push_back(std::move(skin));
    return known->second;
}

}  // namespace farlight
