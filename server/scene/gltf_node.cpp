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
            matrix[column][row] = values[static_cast<std::size_t>(4 * column + row)].get<double>();
    if (glm::row(matrix, 3) != glm::dvec4(0, 0, 0, 1))
        refuse(place, "a projective transform", "a last row of 0, 0, 0, 1");
    return matrix;
}

glm::dmat4 parent_from_node(const Json& node, const ScenePlace& place)
{
    if (node.contains("matrix"))
        return matrix_of(node["matrix"], place / "matrix");
    glm::dmat4 turn(1);
    if (node.contains("rotation")) {
        const Json& r = node["rotation"];  // glm takes w first, glTF has it last
        const glm::dquat rotation(
            r[3].get<double>(), r[0].get<double>(), r[1].get<double>(), r[2].get<double>());
        const double length = glm::length(rotation);
        if (!(length > 0 && length <= std::numeric_limits<float>::max()))
            refuse(place / "rotation", "a quaternion of no length", "a unit quaternion");
        turn = glm::mat4_cast(rotation / length);
    }
    return glm::translate(glm::dmat4(1), vec3_or(node, "translation", glm::dvec3(0))) * turn
        * glm::scale(glm::dmat4(1), vec3_or(node, "scale", glm::dvec3(1)));
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

std::vector<GltfNode> gltf_nodes(const GltfContainer& gltf, std::size_t scene)
{
    const Json& nodes = gltf.list("nodes");
    std::vector<bool> reached(nodes.size(), false);
    std::vector<GltfNode> flat;
    std::vector<Visit> stack;
    const auto push = [&](const Json& owner, const char* key, const glm::dmat4& world,
                          const ScenePlace& place) {
        const auto found = owner.find(key);
        for (std::size_t i = found == owner.end() ? 0 : found->size(); i-- > 0;)
            stack.push_back({(*found)[i].get<std::size_t>(), world, place / key / i});
    };  // backwards: the first is visited first
    push(gltf.list("scenes")[scene], "nodes", glm::dmat4(1), gltf.root / "scenes" / scene);
    while (!stack.empty()) {
        const Visit visit = std::move(stack.back());
        stack.pop_back();
        if (reached[visit.node])
            refuse(visit.reference, "node " + std::to_string(visit.node) + " a second time",
                "a tree: no cycles, one parent a node");
        reached[visit.node] = true;
        const Json& node = nodes[visit.node];
        const ScenePlace place = gltf.root / "nodes" / visit.node;
        const glm::dmat4 world = visit.world_from_parent * parent_from_node(node, place);
        check_bounded(world, place);
        flat.push_back({visit.node, world});
        push(node, "children", world, place);
    }
    return flat;
}

}  // namespace farlight
