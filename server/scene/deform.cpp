// Morphing and skinning on the CPU.
#include "server/scene/deform.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

namespace farlight {
namespace {

/// Takes normals where `m` takes positions, up to a positive factor: the inverse transpose, from
/// cofactors, which also serve a matrix without inverse.
glm::mat3 normal_matrix(const glm::mat3& m)
{
    const glm::mat3 cofactors(
        glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    return glm::dot(m[0], cofactors[0]) < 0 ? -cofactors : cofactors;
}

glm::vec3 unit_or(const glm::vec3& v, const glm::vec3& fallback)
{
    const float length = glm::length(v);
    return length > 0 ? v / length : fallback;
}

void morph(const Mesh& mesh, std::span<const float> weights, VertexPose& pose)
{
    assert(weights.size() <= mesh.morph_targets.size());
    for (std::size_t k = 0; k < weights.size(); ++k) {
        if (weights[k] == 0)
            continue;
        const MorphTarget& target = mesh.morph_targets[k];
        for (std::size_t i = 0; i < target.positions.size(); ++i)
            pose.positions[i] += weights[k] * target.positions[i];
        if (!pose.normals.empty())
            for (std::size_t i = 0; i < target.normals.size(); ++i)
                pose.normals[i] += weights[k] * target.normals[i];
    }
}

void transform_vertex(const glm::mat4& matrix, std::size_t i, VertexPose& pose)
{
    pose.positions[i] = glm::vec3(matrix * glm::vec4(pose.positions[i], 1));
    const glm::mat3 linear(matrix);
    if (!pose.normals.empty())
        pose.normals[i] = unit_or(normal_matrix(linear) * pose.normals[i], {0, 0, 1});
    if (!pose.tangents.empty())
        pose.tangents[i] =
            glm::vec4(unit_or(linear * glm::vec3(pose.tangents[i]), {1, 0, 0}), pose.tangents[i].w);
}

const MeshInstance* instance_of(const Object& object)
{
    return std::get_if<MeshInstance>(&object.shape);
}

bool morphs_with_time(const Scene& scene, std::uint32_t object)
{
    const auto& tracks = scene.animation.tracks;
    return std::any_of(tracks.begin(), tracks.end(), [&](const Track& track) {
        return track.target == Track::Target::kMorphWeights && track.index == object;
    });
}

/// The mesh as its targets leave it at these weights.
Mesh settled(const Mesh& mesh, const std::vector<float>& weights)
{
    VertexPose pose = pose_vertices(mesh, weights, {}, glm::dmat4(1));
    Mesh still = mesh;
    still.positions = std::move(pose.positions);
    still.normals = std::move(pose.normals);
    still.tangents = std::move(pose.tangents);
    still.morph_targets.clear();
    return still;
}

}  // namespace

bool is_skinned(const Scene& scene, const Object& object)
{
    const MeshInstance* instance = instance_of(object);
    return instance != nullptr && instance->skin != kNone
        && !scene.meshes[instance->mesh].joints.empty();
}

bool has_pose(const Scene& scene, const Object& object)
{
    const MeshInstance* instance = instance_of(object);
    return instance != nullptr
        && (is_skinned(scene, object) || !scene.meshes[instance->mesh].morph_targets.empty());
}

bool changes_shape(const Scene& scene, std::uint32_t object, const std::vector<bool>& moving)
{
    const MeshInstance* instance = instance_of(scene.objects[object]);
    if (instance == nullptr)
        return false;
    const auto moves = [&](std::uint32_t joint) { return moving[joint]; };
    if (is_skinned(scene, scene.objects[object])) {
        const auto& joints = scene.animation.skins[instance->skin].joints;
        if (std::any_of(joints.begin(), joints.end(), moves))
            return true;
    }
    return morphs_with_time(scene, object);
}

void settle_morphs(Scene& scene)
{
    std::map<std::pair<std::uint32_t, std::vector<float>>, std::uint32_t> known;
    std::vector<bool> shown(scene.meshes.size(), false);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        auto* instance = std::get_if<MeshInstance>(&scene.objects[i].shape);
        if (instance == nullptr)
            continue;
        if (scene.meshes[instance->mesh].morph_targets.empty() || morphs_with_time(scene, i)) {
            shown[instance->mesh] = true;
            continue;
        }
        const auto next = static_cast<std::uint32_t>(scene.meshes.size());
        const auto [at, is_new] =
            known.try_emplace({instance->mesh, instance->morph_weights}, next);
        if (is_new)
            scene.meshes.push_back(settled(scene.meshes[instance->mesh], instance->morph_weights));
        instance->mesh = at->second;
        instance->morph_weights.clear();
    }
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (!shown[i] && !scene.meshes[i].morph_targets.empty())
            scene.meshes[i] = Mesh{.name = scene.meshes[i].name};
}

std::vector<glm::mat4> skin_matrices(const Skin& skin, std::span<const glm::dmat4> world_from_node)
{
    std::vector<glm::mat4> matrices;
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        matrices.emplace_back(world_from_node[skin.joints[i]] * skin.joint_from_mesh[i]);
    return matrices;
}

VertexPose pose_vertices(const Mesh& mesh, std::span<const float> weights,
    std::span<const glm::mat4> joints, const glm::dmat4& world_from_mesh)
{
    VertexPose pose{mesh.positions, mesh.normals, mesh.tangents};
    morph(mesh, weights, pose);
    const glm::mat4 rigid(world_from_mesh);
    for (std::size_t i = 0; i < pose.positions.size(); ++i) {
        if (joints.empty() || mesh.joints.empty()) {
            transform_vertex(rigid, i, pose);
            continue;
        }
        glm::mat4 blend(0);
        for (int k = 0; k < 4; ++k)
            blend += mesh.weights[i][k] * joints[mesh.joints[i][k]];
        transform_vertex(blend, i, pose);
    }
    return pose;
}

VertexPose pose_object(const Scene& scene, std::uint32_t object, double time,
    std::span<const glm::dmat4> world_from_node, const glm::dvec3& origin)
{
    const auto& instance = std::get<MeshInstance>(scene.objects[object].shape);
    std::vector<glm::mat4> joints;
    if (instance.skin != kNone)
        joints = skin_matrices(scene.animation.skins[instance.skin], world_from_node);
    const std::vector<float> weights =
        morph_weights_at(scene.animation, object, instance.morph_weights, time);
    const std::uint32_t node = scene.objects[object].node;
    glm::dmat4 world_from_mesh = carried(node, world_from_node, instance.world_from_object);
    if (node == kNone)
        world_from_mesh[3] -= glm::dvec4(origin, 0);
    return pose_vertices(scene.meshes[instance.mesh], weights, joints, world_from_mesh);
}

}  // namespace farlight
