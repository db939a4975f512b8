// Without recursion: a chain of nodes may be as long as the file.
#include "server/scene/gltf_node.h"

#include "server/scene/mesh_repair.h"

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

namespace farlight {

namespace {

using Json = nlohmann::json;

glm::dvec3 vec3_or(const Json& node, const char* key, const glm::dvec3& fallback)
{
    const auto found = node.find(key);
    if (found == node.end())
        return fallback;
    return {(*found)[0].get<double>(), (*found)[1].get<double>(), (*found)[2].get<double>()};
}

glm::dmat4 matrix_of(const Json& values, const ScenePlace& place)
{
    glm::dmat4 matrix;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            matrix[column][row] =
                values[4 * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)]
                    .get<double>();
    if (glm::row(matrix, 3) != glm::dvec4(0, 0, 0, 1))
        refuse(place, "a projective transform", "a last row of 0, 0, 0, 1");
    return matrix;
}

glm::dquat rotation_of(const Json& r, std::size_t& changed, const ScenePlace& place)
{
    const glm::dquat rotation(  // glm takes w first, glTF has it last
        r[3].get<double>(), r[0].get<double>(), r[1].get<double>(), r[2].get<double>());
    const double length = glm::length(rotation);
    if (!(length > 0 && length <= std::numeric_limits<float>::max()))
        refuse(place, "a quaternion of no length", "a unit quaternion");
    changed += std::abs(length - 1) <= kRoundedRotation ? 0 : 1;
    return rotation / length;
}

/// Fills transform and parent_from_node.
void read_transform(const Json& json, GltfNode& node, std::size_t& changed, const ScenePlace& place)
{
    Node& transform = node.transform;
    transform.name = json.value("name", "node " + std::to_string(node.index));
    if (json.contains("matrix")) {
        transform.local = node.parent_from_node = matrix_of(json["matrix"], place / "matrix");
        return;
    }
    if (json.contains("rotation"))
        transform.rotation = rotation_of(json["rotation"], changed, place / "rotation");
    transform.translation = vec3_or(json, "translation", glm::dvec3(0));
    transform.scale = vec3_or(json, "scale", glm::dvec3(1));
    node.parent_from_node = glm::translate(glm::dmat4(1), transform.translation)
        * glm::mat4_cast(transform.rotation) * glm::scale(glm::dmat4(1), transform.scale);
}

void check_bounded(const glm::dmat4& matrix, const ScenePlace& place)
{
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(matrix[column][row]) <= kLargestCoordinate))
                refuse(place, "a transform beyond 1e11", "numbers of at most 1e11 in magnitude");
}

struct Visit {
    std::size_t node;
    std::uint32_t parent;  // in the tree
    ScenePlace reference;  // where the file names this node
};

}  // namespace

std::uint32_t GltfTree::find(std::size_t index) const
{
    return places[index];
}

GltfTree read_gltf_tree(const GltfContainer& gltf, std::size_t scene)
{
    const Json& nodes = gltf.list("nodes");
    GltfTree tree;
    tree.places.resize(nodes.size(), kNone);
    std::vector<Visit> stack;
    const auto push = [&](const Json& owner, const char* key, std::uint32_t parent,
                          const ScenePlace& place) {
        const auto found = owner.find(key);
        for (std::size_t i = found == owner.end() ? 0 : found->size(); i-- > 0;)
            stack.push_back({(*found)[i].get<std::size_t>(), parent, place / key / i});
    };  // backwards: the first is visited first
    push(gltf.list("scenes")[scene], "nodes", kNone, gltf.root / "scenes" / scene);
    while (!stack.empty()) {
        const Visit visit = std::move(stack.back());
        stack.pop_back();
        if (tree.places[visit.node] != kNone)
            refuse(visit.reference, "node " + std::to_string(visit.node) + " a second time",
                "a tree: no cycles, one parent a node");
        const auto here = static_cast<std::uint32_t>(tree.nodes.size());
        tree.places[visit.node] = here;
        const ScenePlace place = gltf.root / "nodes" / visit.node;
        GltfNode node{.index = visit.node, .parent = visit.parent};
        read_transform(nodes[visit.node], node, tree.changed_rotations, place);
        node.world_from_node = visit.parent == kNone
            ? node.parent_from_node
            : tree.nodes[visit.parent].world_from_node * node.parent_from_node;
        check_bounded(node.world_from_node, place);
        tree.nodes.push_back(std::move(node));
        push(nodes[visit.node], "children", here, place);
    }
    return tree;
}

}  // namespace farlight
