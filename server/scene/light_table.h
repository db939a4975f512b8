// LightTable: all lights of a scene at one moment, and the probability of choosing each.
#pragma once

#include "server/scene/alias_table.h"
#include "server/scene/effects.h"
#include "server/scene/light_tree.h"
#include "server/scene/texels.h"
#include "server/scene/textures.h"

#include <span>

namespace farlight {

/// What animation makes of the lights; an empty list leaves everything as the scene has it.
struct LightPose {
    std::span<const float> emission;  ///< Factor on that of each material.
    std::span<const float> intensity;  ///< Factor on that of each of Scene::lights.
    std::span<const glm::dmat4> world_from_node;  ///< Of each node.
    float background = 1;  ///< Factor on Scene::background.
    glm::dvec3 origin{0};  ///< Of the space they are wanted in, in the scene's coordinates.
};

/// Lights keep their index for ever: first the area lights as they were given, then Scene::lights,
/// last the environment map if there is one. A light without power stays, and is never chosen.
///
/// Few lights are chosen by power. Of many, those that have a place are chosen by a tree, which
/// knows what matters where (light_tree.h), and how often the tree is asked follows from their
/// power.
class LightTable {
public:
    /// `area_lights`: the shapes of what is_sampled(), with their `object` (see lights.h).
    /// `layout` has been laid out. The scene must outlive the table. `tree_from`: the least number
    /// of lights with a place that get a tree.
    LightTable(const Scene& scene, const TextureLayout& layout, std::vector<Light> area_lights,
        std::size_t tree_from = kLightTreeFrom);

    /// `shapes`: the area lights again, where they are now; empty: where they were.
    void update(std::span<const Light> shapes, const LightPose& pose);

    const std::vector<Light>& all() const { return lights_; }
    std::uint32_t count() const { return static_cast<std::uint32_t>(lights_.size()); }
    /// Adds what there is of each kind, and the nodes of the tree.
    void count_kinds(SceneContent& content) const;

    /// As shaders read them (shaders/shared/scene_layout.h). Sizes never change.
    const Texels& lights() const { return packed_; }
    const Texels& textures() const { return textures_; }
    const Texels& environment() const { return environment_; }
    const Texels& tree() const { return tree_; }  ///< Empty: no tree.

private:
    void pose_area_lights(std::span<const Light> shapes, const LightPose& pose);
    void pose_punctual_lights(const LightPose& pose);
    void choose_by_power();
    void choose_by_tree();
    void pack(std::span<const AliasSlot> slots);

    const Scene& scene_;
    double scene_radius_ = 1;
    std::size_t area_lights_ = 0;
    std::vector<Light> lights_;  ///< As posed.
    std::vector<Light> rest_;  ///< Before any factor.
    std::vector<std::uint32_t> texture_places_;  ///< One an area light.
    glm::dvec3 mean_environment_{0};
    Texels packed_;
    Texels textures_;
    Texels environment_;
    std::vector<std::uint32_t> placed_;  ///< Lights that have a place, if there is a tree.
    Texels tree_;
    std::vector<std::uint32_t> trails_;  ///< One a light.
};

}  // namespace farlight
