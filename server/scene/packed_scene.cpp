// The steps from a Scene to its tables: flatten, tree, effects, pack.
#include "server/scene/packed_scene.h"

#include "server/scene/albedo_tables.h"
#include "server/scene/bvh.h"
#include "server/scene/materials.h"

#include <cmath>
#include <limits>

namespace farlight {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A sphere's or disk's extremes are rounded: one step outwards keeps them inside.
PrimitiveBounds widened(const glm::vec3& lower, const glm::vec3& upper)
{
    PrimitiveBounds bounds{};
    for (int axis = 0; axis < 3; ++axis) {
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

Bvh tree_over(const FlatScene& flat)
{
    const std::size_t count = flat.triangles.size() + flat.spheres.size() + flat.disks.size();
    std::vector<PrimitiveBounds> bounds;
    std::vector<PrimitiveKind> kinds;
    bounds.reserve(count);
    kinds.reserve(count);
    for (const FlatTriangle& triangle : flat.triangles) {
        const auto& [a, b, c] = triangle.vertices;
        bounds.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
        kinds.push_back(PrimitiveKind::kTriangle);
    }
    for (const FlatSphere& sphere : flat.spheres) {
        bounds.push_back(widened(sphere.center - sphere.radius, sphere.center + sphere.radius));
        kinds.push_back(PrimitiveKind::kSphere);
    }
    for (const FlatDisk& disk : flat.disks) {
        bounds.push_back(bounds_of(disk));
        kinds.push_back(PrimitiveKind::kDisk);
    }
    return build_bvh(bounds, kinds);
}

SceneContent content_of(const Scene& scene, const FlatScene& flat)
{
    SceneContent content;
    content.drawn.assign(scene.objects.size(), 0);
    content.triangles = flat.triangles.size();
    content.spheres = flat.spheres.size();
    content.disks = flat.disks.size();
    for (const FlatSphere& sphere : flat.spheres)
        content.drawn[sphere.object] = 1;
    for (const FlatDisk& disk : flat.disks)
        content.drawn[disk.object] = 1;
    for (const FlatTriangle& triangle : flat.triangles) {
        content.drawn[triangle.object] = 1;
        const auto* instance = std::get_if<MeshInstance>(&scene.objects[triangle.object].shape);
        if (instance != nullptr && !scene.meshes[instance->mesh].normals.empty())
            ++content.smooth_triangles;
    }
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

}  // namespace

PackedScene pack_scene(const Scene& scene, const TextureLimits& limits)
{
    FlatScene flat = flatten(scene);
    Bvh bvh = tree_over(flat);
    PackedScene packed{.textures = TextureLayout(scene.images)};
    for (const Material& material : scene.materials)
        each_texture(material, [&](const Texture& texture, TexelSpace space) {
            packed.textures.need(texture, space);
        });
    packed.textures.lay_out(limits);
    packed.lights.emplace(scene, packed.textures, std::move(flat.lights));
    packed.content = content_of(scene, flat);
    packed.lights->count_kinds(packed.content);
    packed.effects = active_effects(scene, packed.content);
    packed.bvh_nodes = std::move(bvh.nodes);
    packed.stack_depth = bvh.stack_depth;
    packed.geometry =
        pack_geometry(scene, flat, bvh.order, attributes_for(mask_of(packed.effects)));
    packed.materials = pack_materials(scene.materials, packed.textures);
    if (scatters_roughly(scene.materials))
        packed.reflection_albedo = reflection_albedo_table();
    if (mask_of(packed.effects).has("FX_ROUGH_DIELECTRIC"))
        packed.dielectric_albedo = dielectric_albedo_table();
    packed.dropped_triangles = flat.dropped_triangles;
    return packed;
}

std::vector<std::pair<const char*, const Texels*>> PackedScene::tables() const
{
    return {{"bvh_nodes", &bvh_nodes}, {"triangles", &geometry.triangles},
        {"spheres", &geometry.spheres}, {"disks", &geometry.disks}, {"normals", &geometry.normals},
        {"uvs", &geometry.uvs[0]}, {"uvs1", &geometry.uvs[1]}, {"tangents", &geometry.tangents},
        {"colors", &geometry.colors}, {"materials", &materials},
        {"reflection_albedo", &reflection_albedo}, {"dielectric_albedo", &dielectric_albedo},
        {"lights", &lights->lights()}, {"light_tree", &lights->tree()},
        {"light_textures", &lights->textures()}, {"environment", &lights->environment()}};
}

}  // namespace farlight
