// Posing: nodes, then instances and vertices, then the tree over them.
#include "server/scene/moving_scene.h"

#include "server/scene/instance_transform.h"
#include "server/scene/pack_geometry.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cassert>

namespace farlight {
namespace {

/// What posing needs of the scene: images and meshes that keep their shape are heavy.
Scene moving_part(const Scene& scene, const std::vector<DeformingMesh>& meshes)
{
    Scene part;
    part.materials = scene.materials;
    part.objects = scene.objects;
    part.animation = scene.animation;
    part.meshes.resize(scene.meshes.size());
    for (const DeformingMesh& mesh : meshes) {
        const auto index = std::get<MeshInstance>(scene.objects[mesh.object()].shape).mesh;
        part.meshes[index] = scene.meshes[index];
    }
    return part;
}

}  // namespace

MovingScene::MovingScene(const Scene& scene, const FlatScene& flat,
    std::span<const TreePlace> trees, std::span<const glm::uvec4> nodes,
    std::vector<DeformingMesh> meshes, DeformingTables deforming)
    : scene_(moving_part(scene, meshes))
    , instance_lights_(flat.instance_lights)
    , lights_(flat.lights)
    , meshes_(std::move(meshes))
    , deforming_(std::move(deforming))
    , stack_depth_(trees[0].stack_depth)
    , wide_(flat.wide)
{
    if (flat.instances.empty() && meshes_.empty()) {
        now_ = prev_ = moment(0, glm::dvec3(0));
        return;
    }
    int deepest = 0;
    if (flat.groups[0].size() > 0) {
        world_ = TopLevelEntry{root_bounds(nodes, trees[0].root), trees[0].root};
        deepest = trees[0].stack_depth;
    }
    for (const FlatInstance& instance : flat.instances) {
        const TreePlace& tree = trees[instance.group];
        instances_.push_back(
            {instance.object, instance.light, tree.root, root_bounds(nodes, tree.root)});
        // An instance's own tree stands on the word that ends it.
        deepest = std::max(deepest, tree.stack_depth + 1);
    }
    for (const DeformingMesh& mesh : meshes_)
        deepest = std::max(deepest, mesh.tree().stack_depth);
    const std::size_t entries = instances_.size() + meshes_.size() + (world_.has_value() ? 1 : 0);
    stack_depth_ = top_level_stack(entries) + deepest;
    top_level_.resize(top_level_texels(entries));
    instance_texels_.resize(instances_.size() * INSTANCE_TEXELS);
    const std::vector<bool> moving = moving_nodes(scene_.animation);
    const bool moves = std::any_of(instances_.begin(), instances_.end(), [&](const Instance& i) {
        const std::uint32_t node = scene_.objects[i.object].node;
        return node != kNone && moving[node];
    });
    if (moves)
        prev_instance_texels_.resize(instances_.size() * PREV_INSTANCE_TEXELS);
    pose(0, 0);
}

std::shared_ptr<const MovingScene::Moment> MovingScene::moment(
    double time, const glm::dvec3& origin) const
{
    const glm::dvec4 offset(origin, 0);
    auto m = std::make_shared<Moment>();
    m->time = time;
    m->origin = origin;
    m->world_from_node = pose_nodes(scene_.animation, time);
    for (glm::dmat4& world : m->world_from_node)
        world[3] -= offset;
    for (const Instance& instance : instances_) {
        const Object& object = scene_.objects[instance.object];
        m->world_from_group.push_back(
            carried(object.node, m->world_from_node, placement_of(object)));
        if (object.node == kNone)
            m->world_from_group.back()[3] -= offset;
    }
    for (const DeformingMesh& mesh : meshes_)
        m->vertices.push_back(pose_object(scene_, mesh.object(), time, m->world_from_node, origin));
    return m;
}

MovingScene::Changes MovingScene::pose(double time, double prev_time, const glm::dvec3& origin)
{
    assert(wide_ || origin == glm::dvec3(0));
    // A frame's previous time is mostly the last frame's time.
    const auto known = [&](double wanted) {
        for (const auto& m : {now_, prev_})
            if (m != nullptr && m->time == wanted && m->origin == origin)
                return m;
        return moment(wanted, origin);
    };
    const auto now = known(time);
    const auto prev = prev_time == time ? now : known(prev_time);
    const Changes changes{now != now_, prev != prev_};
    now_ = now;
    prev_ = prev;
    if (changes.now)
        pack_now();
    if (changes.previous)
        pack_previous();
    return changes;
}

void MovingScene::pack_now()
{
    for (std::size_t i = 0; i < instances_.size(); ++i)
        pack_instance(i);
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        meshes_[i].pack(now_->vertices[i], deforming_);
        meshes_[i].move_lights(now_->vertices[i], lights_);
    }
    for (const FlatInstanceLight& light : instance_lights_) {
        const Light moved = transformed(light.shape, now_->world_from_group[light.instance]);
        Light& target = lights_[light.light];
        target.p0 = moved.p0, target.edge_u = moved.edge_u, target.edge_v = moved.edge_v;
        target.area = moved.area;
    }
    if (!top_level_.empty())
        rebuild_top_level();
}

void MovingScene::pack_previous()
{
    for (std::size_t i = 0; i * PREV_INSTANCE_TEXELS < prev_instance_texels_.size(); ++i)
        pack_rows(prev_->world_from_group[i],
            std::span(prev_instance_texels_).subspan(i * PREV_INSTANCE_TEXELS));
    for (std::size_t i = 0; i < meshes_.size(); ++i)
        meshes_[i].pack_previous(prev_->vertices[i], deforming_);
}

void MovingScene::pack_instance(std::size_t i)
{
    const Instance& instance = instances_[i];
    const glm::dmat4& m = now_->world_from_group[i];
    const std::span<glm::uvec4> texels =
        std::span(instance_texels_).subspan(i * INSTANCE_TEXELS, INSTANCE_TEXELS);
    pack_rows(glm::inverse(m), texels.subspan(INSTANCE_OBJECT_FROM_WORLD));
    texels[INSTANCE_IDS] = {
        instance.root, instance.object, material_word(scene_, instance.object), instance.light};
    pack_rows(m, texels.subspan(INSTANCE_WORLD_FROM_OBJECT));
    const bool mirrored = glm::determinant(glm::dmat3(m)) < 0;
    texels[INSTANCE_SCALE] = {
        bits(static_cast<float>(std::log2(scale_of(m)))), bits(mirrored ? -1.0F : 1.0F), 0, 0};
}

void MovingScene::rebuild_top_level()
{
    std::vector<TopLevelEntry> entries;
    if (world_)
        entries.push_back(*world_);
    for (std::size_t i = 0; i < instances_.size(); ++i) {
        const glm::dmat4& m = now_->world_from_group[i];
        // A thing squeezed flat or to a point, as animations do to hide it, is not there.
        if (is_invertible(m))
            entries.push_back({transformed(instances_[i].bounds, m),
                BVH_LEAF_BIT | BVH_INSTANCES | static_cast<std::uint32_t>(i)});
    }
    for (const DeformingMesh& mesh : meshes_)
        entries.push_back({root_bounds(std::span<const glm::uvec4>(deforming_.bvh_nodes),
                               mesh.tree().root - deforming_.first_node),
            mesh.tree().root});
    build_top_level(entries, top_level_);
}

}  // namespace farlight
