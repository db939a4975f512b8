// The steps from a Scene to its tables: flatten, tree, effects, pack.
#include "server/scene/packed_scene.h"

#include "server/host_guard.h"
#include "server/scene/albedo_tables.h"
#include "server/scene/bvh.h"
#include "server/scene/materials.h"
#include "server/scene/scene_error.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace farlight {
namespace {

const HostGuard round_boxes_widened("round_boxes_widened");

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A sphere's or disk's extremes are rounded: one step outwards keeps them inside.
PrimitiveBounds widened(const glm::vec3& lower, const glm::vec3& upper)
{
    PrimitiveBounds bounds{lower, upper};
    for (int axis = 0; round_boxes_widened && axis < 3; ++axis) {
        bounds.lower[axis] = std::nextafter(lower[axis], -kInfinity);
        bounds.upper[axis] = std::nextafter(upper[axis], kInfinity);
    }
    return bounds;
}

PrimitiveBounds bounds_of(const FlatDisk& disk)
{
    // A disk reaches radius * sin(angle to its normal) along an axis.
    const glm::dvec3 n(disk.normal);
    const glm::dvec3 reach =
        static_cast<double>(disk.radius) * glm::sqrt(glm::max(glm::dvec3(0), 1.0 - n * n));
    const glm::dvec3 center(disk.center);
    return widened(glm::vec3(center - reach), glm::vec3(center + reach));
}

Bvh tree_over(const FlatGroup& group)
{
    std::vector<PrimitiveBounds> bounds;
    std::vector<PrimitiveKind> kinds;
    bounds.reserve(group.size());
    kinds.reserve(group.size());
    for (const FlatTriangle& triangle : group.triangles) {
        const auto& [a, b, c] = triangle.vertices;
        bounds.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
        kinds.push_back(PrimitiveKind::kTriangle);
    }
    for (const FlatSphere& sphere : group.spheres) {
        bounds.push_back(widened(sphere.center - sphere.radius, sphere.center + sphere.radius));
        kinds.push_back(PrimitiveKind::kSphere);
    }
    for (const FlatDisk& disk : group.disks) {
        bounds.push_back(bounds_of(disk));
        kinds.push_back(PrimitiveKind::kDisk);
    }
    return build_bvh(bounds, kinds);
}

SceneContent content_of(const Scene& scene, const FlatScene& flat)
{
    SceneContent content;
    content.drawn.assign(scene.objects.size(), 0);
    for (const FlatGroup& group : flat.groups) {
        content.triangles += group.triangles.size();
        content.spheres += group.spheres.size();
        content.disks += group.disks.size();
        for (const FlatTriangle& triangle : group.triangles) {
            content.drawn[triangle.object] = 1;
            const Mesh* mesh = flat.objects[triangle.object].mesh;
            content.smooth_triangles += mesh != nullptr && !mesh->normals.empty() ? 1 : 0;
        }
        for (const FlatSphere& sphere : group.spheres)
            content.drawn[sphere.object] = 1;
        for (const FlatDisk& disk : group.disks)
            content.drawn[disk.object] = 1;
    }
    content.instances = flat.instances.size();
    const std::vector<bool> moving = moving_nodes(scene.animation);
    for (const FlatInstance& instance : flat.instances) {
        content.drawn[instance.object] = 1;
        const std::uint32_t node = scene.objects[instance.object].node;
        if (!content.placed)
            content.placed = instance.object;
        if (!content.moving && node != kNone && moving[node])
            content.moving = instance.object;
    }
    for (const std::uint32_t object : flat.deforming_objects)
        if (!content.deforming && content.drawn[object] != 0)
            content.deforming = object;
    return content;
}

WantedAttributes attributes_for(EffectMask effects)
{
    WantedAttributes wanted;
    wanted.normals = effects.has("FX_SHADING_NORMALS");
    wanted.uvs[0] = effects.has("FX_TEXTURES");
    wanted.uvs[1] = effects.has("FX_SECOND_UVS");
    wanted.tangents = effects.has("FX_NORMAL_MAPS");
    wanted.colors = effects.has("FX_VERTEX_COLORS");
    return wanted;
}

/// Puts the trees of all groups behind each other, and the geometry in their order.
class TreePacker {
public:
    TreePacker(const Scene& scene, const FlatScene& flat, PackedScene& target)
        : flat_(flat)
        , target_(target)
        , geometry_(scene, flat, attributes_for(mask_of(target.effects)))
    {
        // A lone world has no level above it.
        const std::size_t world = flat.groups[0].size() > 0 ? 1 : 0;
        const std::size_t others = flat.instances.size() + flat.deforming_objects.size();
        if (others > 0)
            target.bvh_nodes.resize(top_level_texels(world + others));
    }

    MovingScene run(const Scene& scene)
    {
        std::vector<DeformingMesh> meshes;
        DeformingTables deforming;
        for (std::uint32_t i = 0; i < flat_.groups.size(); ++i) {
            if (i == flat_.first_deforming) {
                deforming.first_node = static_cast<std::uint32_t>(target_.bvh_nodes.size());
                deforming.first_triangle = triangle_count();
            }
            const std::uint32_t first = triangle_count() - deforming.first_triangle;
            const Bvh bvh = add_tree(flat_.groups[i]);
            if (i >= flat_.first_deforming && flat_.groups[i].size() > 0)
                meshes.emplace_back(flat_, flat_.groups[i], bvh.order, first, places_.back());
        }
        target_.geometry = std::move(geometry_.packed());
        if (!meshes.empty())
            take_tails(deforming);
        return {scene, flat_, places_, target_.bvh_nodes, std::move(meshes), std::move(deforming)};
    }

private:
    std::uint32_t triangle_count()
    {
        return static_cast<std::uint32_t>(geometry_.packed().triangles.size() / TRIANGLE_TEXELS);
    }

    Bvh add_tree(const FlatGroup& group)
    {
        Bvh bvh = tree_over(group);
        const PackedGeometry& before = geometry_.packed();
        const auto root = static_cast<std::uint32_t>(target_.bvh_nodes.size());
        relocate(bvh.nodes, root,
            {triangle_count(), static_cast<std::uint32_t>(before.spheres.size() / SPHERE_TEXELS),
                static_cast<std::uint32_t>(before.disks.size() / DISK_TEXELS)});
        if (target_.bvh_nodes.empty())
            target_.bvh_nodes = std::move(bvh.nodes);
        else
            target_.bvh_nodes.insert(target_.bvh_nodes.end(), bvh.nodes.begin(), bvh.nodes.end());
        geometry_.pack(group, bvh.order);
        places_.push_back(
            {root, static_cast<std::uint32_t>(target_.bvh_nodes.size()), bvh.stack_depth});
        return bvh;
    }

    /// Copies of what will change.
    void take_tails(DeformingTables& tables)
    {
        const auto tail = [](const Texels& table, std::size_t first) {
            return table.empty()
                ? Texels()
                : Texels(table.begin() + static_cast<std::ptrdiff_t>(first), table.end());
        };
        const PackedGeometry& g = target_.geometry;
        tables.bvh_nodes = tail(target_.bvh_nodes, tables.first_node);
        tables.triangles = tail(g.triangles, tables.first_triangle * std::size_t{TRIANGLE_TEXELS});
        tables.normals = tail(g.normals, tables.first_triangle);
        tables.tangents = tail(g.tangents, tables.first_triangle);
        tables.prev_vertices.resize(PREV_VERTEX_HEADER + tables.triangles.size());
        tables.prev_vertices[0] = {
            tables.first_triangle, tables.triangles.size() / std::size_t{TRIANGLE_TEXELS}, 0, 0};
    }

    const FlatScene& flat_;
    PackedScene& target_;
    GeometryPacker geometry_;
    std::vector<TreePlace> places_;
};

PackedScene all_tables(const Scene& scene, const TextureLimits& limits)
{
    const FlatScene flat = flatten(scene);
    PackedScene packed{.textures = TextureLayout(scene.images)};
    for (const Material& material : scene.materials)
        each_texture(material, [&](const Texture& texture, TexelSpace space) {
            packed.textures.need(texture, space);
        });
    packed.textures.lay_out(limits);
    packed.lights.emplace(scene, packed.textures, flat.lights);
    packed.content = content_of(scene, flat);
    packed.lights->count_kinds(packed.content);
    packed.effects = active_effects(scene, packed.content);
    packed.moving.emplace(TreePacker(scene, flat, packed).run(scene));
    packed.stack_depth = packed.moving->stack_depth();
    const Texels& top_level = packed.moving->top_level();
    std::copy(top_level.begin(), top_level.end(), packed.bvh_nodes.begin());
    packed.lights->update(
        packed.moving->lights(), {.world_from_node = packed.moving->world_from_node()});
    packed.materials = pack_materials(scene.materials, packed.textures);
    if (scatters_roughly(scene.materials))
        packed.reflection_albedo = reflection_albedo_table();
    if (mask_of(packed.effects).has("FX_ROUGH_DIELECTRIC"))
        packed.dielectric_albedo = dielectric_albedo_table();
    packed.dropped_triangles = flat.dropped_triangles;
    return packed;
}

}  // namespace

PackedScene pack_scene(const Scene& scene, const TextureLimits& limits)
{
    return within_memory({scene.file, {}}, [&] { return all_tables(scene, limits); });
}

std::vector<std::pair<const char*, const Texels*>> PackedScene::tables() const
{
    return {{"bvh_nodes", &bvh_nodes}, {"triangles", &geometry.triangles},
        {"spheres", &geometry.spheres}, {"disks", &geometry.disks}, {"normals", &geometry.normals},
        {"uvs", &geometry.uvs[0]}, {"uvs1", &geometry.uvs[1]}, {"tangents", &geometry.tangents},
        {"colors", &geometry.colors}, {"materials", &materials},
        {"reflection_albedo", &reflection_albedo}, {"dielectric_albedo", &dielectric_albedo},
        {"lights", &lights->lights()}, {"light_tree", &lights->tree()},
        {"instances", &moving->instances()}, {"prev_instances", &moving->prev_instances()},
        {"prev_vertices", &moving->deforming().prev_vertices},
        {"light_textures", &lights->textures()}, {"environment", &lights->environment()}};
}

}  // namespace farlight
