// A Scene as arrays of 16-byte texels (shaders/shared/scene_layout.h), still on the CPU.
#pragma once

#include "server/scene/effects.h"
#include "server/scene/light_table.h"
#include "server/scene/moving_scene.h"
#include "server/scene/pack_geometry.h"
#include "server/scene/textures.h"

#include <optional>
#include <utility>

namespace farlight {

struct PackedScene {
    Texels bvh_nodes;
    PackedGeometry geometry;
    Texels materials;
    Texels reflection_albedo;
    Texels dielectric_albedo;
    std::optional<LightTable> lights;  ///< Never absent once packed.
    std::optional<MovingScene> moving;  ///< Never absent once packed; at time 0.
    TextureLayout textures;
    SceneContent content;
    std::vector<ActiveEffect> effects;
    std::size_t dropped_triangles = 0;  ///< Zero area or not finite once in world space.
    int stack_depth = 0;

    /// Every table by the name shaders use; empty where the scene has nothing for it.
    std::vector<std::pair<const char*, const Texels*>> tables() const;
};

/// Flattens objects, builds the tree and the light table, lays out textures. Needs no GL. The scene
/// must outlive the result.
PackedScene pack_scene(const Scene& scene, const TextureLimits& limits = {});

}  // namespace farlight
