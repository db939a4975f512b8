// Without recursion: a chain of nodes may be as long as the file.
#include "server/scene/gltf_node.h"

#include "server/scene/mesh_repair.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <tiny_gltf.h>

namespace farlight {

namespace {

glm::dvec3 vec3_or(const std::vector<double>& value, const glm::dvec3& fallback)
{
    return value.size() == 3 ? glm::dvec3(value[0], value[1], value[2]) : fallback;
}

glm::dmat4 parent_from_node(const tinygltf::Node& node, const ScenePlace& place)
{
    glm::dmat4 matrix(1);
    if (node.matrix.size() == 16) {
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                matrix[column][row] = node.matrix[4 * static_cast<std::size_t>(column)
                    + static_cast<std::size_t>(row)];
        if (glm::dvec4(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3])
            != glm::dvec4(0, 0, 0, 1))
            refuse(place / "matrix", "a projective transform", "a last row of 0, 0, 0, 1");
        return matrix;
    }
    glm::dmat4 turn(1);
    if (node.rotation.size() == 4) {
        const auto& r = node.rotation;
        const glm::dquat rotation = glm::dquat(r[3], r[0], r[1], r[2]);  // w first; glTF: x first
        const double length = glm::length(rotation);
        if (!(length > 0 && length <= std::numeric_limits<float>::max()))
            refuse(place / "rotation", "a quaternion of no length", "a unit quaternion");
        turn = glm::mat4_cast(rotation / length);
    }
    return glm::translate(matrix, vec3_or(node.translation, glm::dvec3(0))) * turn
        * glm::scale(glm::dmat4(1), vec3_or(node.scale, glm::dvec3(1)));
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
    glm::dmat4 world_from_parent;
    ScenePlace reference;  // where the file names this node
};

}  // namespace

std::vector<GltfNode> gltf_nodes(
    const tinygltf::Model& model, std::size_t scene, const ScenePlace& root)
{
    std::vector<bool> reached(model.nodes.size(), false);
    std::vector<GltfNode> flat;
    std::vector<Visit> stack;
    const auto push = [&](const std::vector<int>& nodes, const glm::dmat4& world,
                          const ScenePlace& place) {
        for (std::size_t i = nodes.size(); i-- > 0;)  // backwards: the first is visited first
            stack.push_back({static_cast<std::size_t>(nodes[i]), world, place / i});
    };
    push(model.scenes[scene].nodes, glm::dmat4(1), root / "scenes" / scene / "nodes");
    while (!stack.empty()) {
        const Visit visit = std::move(stack.back());
        stack.pop_back();
        if (reached[visit.node])
            refuse(visit.reference, "node " + std::to_string(visit.node) + " a second time",
                "a tree: no cycles, one parent a node");
        reached[visit.node] = true;
        const tinygltf::Node& node = model.nodes[visit.node];
        const ScenePlace place = root / "nodes" / visit.node;
        const glm::dmat4 world = visit.world_from_parent * parent_from_node(node, place);
        check_bounded(world, place);
        flat.push_back({visit.node, world});
        push(node.children, world, place / "children");
    }
    return flat;
}

}  // namespace farlight
