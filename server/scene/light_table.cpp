// Posing lights, their power, the alias table, packing.
#include "server/scene/light_table.h"

#include "server/host_guard.h"
#include "server/scene/environment.h"
#include "server/scene/light_textures.h"

#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace farlight {
namespace {

const HostGuard chosen_by_power("chosen_by_power");

float factor(std::span<const float> factors, std::size_t index)
{
    return factors.empty() ? 1 : factors[index];
}

void scale(Light& light, const Light& rest, float by)
{
    light.radiance = rest.radiance * by;
    light.mean_luminance = rest.mean_luminance * static_cast<double>(by);
}

}  // namespace

LightTable::LightTable(const Scene& scene, const TextureLayout& layout,
    std::vector<Light> area_lights, std::size_t tree_from)
    : scene_(scene)
    , area_lights_(area_lights.size())
    , lights_(std::move(area_lights))
{
    const Bounds bounds = scene_bounds(scene);
    if (!bounds.empty() && bounds.radius() > 0)
        scene_radius_ = bounds.radius();
    LightTextures textures(scene, layout);
    for (Light& light : lights_)
        texture_places_.push_back(textures.add(light));
    textures_ = textures.texels();
    for (const PunctualLight& punctual : scene.lights)
        lights_.push_back(light_of(punctual, glm::dmat4(1)));
    if (scene.environment) {
        PackedEnvironment packed = pack_environment(*scene.environment, scene.map_from_world);
        environment_ = std::move(packed.texels);
        Light light{.kind = LIGHT_ENVIRONMENT};
        light.mean_luminance = luminance(glm::dvec3(scene.background) * packed.mean_radiance);
        lights_.push_back(light);
    }
    for (std::uint32_t i = 0; i < lights_.size(); ++i)
        if (lights_[i].kind < LIGHT_DIRECTIONAL)
            placed_.push_back(i);
    if (placed_.size() < tree_from)
        placed_.clear();
    rest_ = lights_;
    update({}, {});
}

void LightTable::update(std::span<const Light> shapes, const LightPose& pose)
{
    assert(shapes.empty() || shapes.size() == area_lights_);
    pose_area_lights(shapes, pose);
    pose_punctual_lights(pose);
    if (scene_.environment)
        scale(lights_.back(), rest_.back(), pose.background);
    for (Light& light : lights_)
        light.power = light_power(light, scene_radius_);
    choose_by_power();
    if (!placed_.empty())
        choose_by_tree();
}

void LightTable::pose_area_lights(std::span<const Light> shapes, const LightPose& pose)
{
    for (std::size_t i = 0; i < area_lights_; ++i) {
        Light& light = lights_[i];
        scale(light, rest_[i], factor(pose.emission, scene_.objects[light.object].material));
        if (shapes.empty())
            continue;
        light.p0 = shapes[i].p0;
        light.edge_u = shapes[i].edge_u;
        light.edge_v = shapes[i].edge_v;
        light.area = shapes[i].area;
    }
}

void LightTable::pose_punctual_lights(const LightPose& pose)
{
    const glm::dmat4 world_from_scene = glm::translate(glm::dmat4(1), -pose.origin);
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        Light& light = lights_[area_lights_ + i];
        const std::uint32_t node = scene_.lights[i].node;
        light = light_of(scene_.lights[i],
            node != kNone && !pose.world_from_node.empty() ? pose.world_from_node[node]
                                                           : world_from_scene);
        scale(light, light, factor(pose.intensity, i));
    }
}

void LightTable::choose_by_power()
{
    std::vector<double> weights;
    double total = 0;
    for (const Light& light : lights_) {
        assert(light.power >= 0 && std::isfinite(light.power));
        weights.push_back(chosen_by_power ? light.power : 1);
        total += weights.back();
    }
    for (std::size_t i = 0; i < lights_.size(); ++i)
        lights_[i].pmf = total > 0 ? static_cast<float>(weights[i] / total) : 0;
    trails_.assign(lights_.size(), 0);
    pack(alias_table(weights));
}

void LightTable::choose_by_tree()
{
    double asked = 0;
    std::vector<Light> placed;
    for (const std::uint32_t i : placed_) {
        asked += static_cast<double>(lights_[i].pmf);
        placed.push_back(lights_[i]);
    }
    const LightTree tree = build_light_tree(placed, placed_);
    for (std::size_t i = 0; i < placed_.size(); ++i) {
        lights_[placed_[i]].pmf = static_cast<float>(asked);
        trails_[placed_[i]] = tree.trails[i];
    }
    tree_.assign(1,
        {tree.nodes.size() / LIGHT_NODE_TEXELS, lights_.size() - placed_.size(),
            bits(static_cast<float>(asked)), 0});
    tree_.insert(tree_.end(), tree.nodes.begin(), tree.nodes.end());
    for (std::uint32_t i = 0; i < lights_.size(); ++i)
        if (lights_[i].kind >= LIGHT_DIRECTIONAL)
            tree_.emplace_back(i, 0, 0, 0);
    pack(std::vector<AliasSlot>(lights_.size()));
}

void LightTable::pack(std::span<const AliasSlot> slots)
{
    packed_.clear();
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const Light& light = lights_[i];
        packed_.emplace_back(light.kind | (light.emits_both_sides ? LIGHT_EMITS_BOTH_SIDES : 0),
            i < area_lights_ ? texture_places_[i] : 0, bits(light.pmf), bits(light.area));
        packed_.push_back(texel(light.p0, bits(slots[i].threshold)));
        packed_.push_back(texel(light.edge_u, slots[i].alias));
        packed_.push_back(texel(light.edge_v, 0));
        packed_.push_back(texel(light.radiance, trails_[i]));
    }
}

void LightTable::count_kinds(SceneContent& content) const
{
    for (const Light& light : rest_)
        switch (light.kind) {
        case LIGHT_QUAD: ++content.polygon_lights; break;
        case LIGHT_TRIANGLE: ++content.emissive_triangles; break;
        case LIGHT_SPHERE: ++content.sphere_lights; break;
        case LIGHT_DISK: ++content.disk_lights; break;
        case LIGHT_ENVIRONMENT: break;
        default: content.delta_lights += light.mean_luminance > 0 ? 1 : 0; break;
        }
    if (!tree_.empty())
        content.light_tree_nodes += tree_.front().x;
}

}  // namespace farlight
