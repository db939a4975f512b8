// The registry of effects: what a scene may call for, how that is seen, and the macro that compiles
// it in. What a scene lacks is not compiled. To add an effect: one row in effects.cpp, one #if in a
// shader.
#pragma once

#include "server/scene/scene.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

/// What is left of a scene in world space, in single precision: what has no extent or no power is
/// not there.
struct SceneContent {
    std::size_t triangles = 0;
    std::size_t smooth_triangles = 0;  ///< With shading normals of their own.
    std::size_t spheres = 0;
    std::size_t polygon_lights = 0;
    std::size_t sphere_lights = 0;
};

struct Effect {
    std::string_view name;  ///< As shown by `farlight info`.
    std::string_view macro;  ///< Defined in shaders when the scene calls for the effect.
    /// Why the scene calls for it ("4 spheres, first 'ground'"), or nothing.
    std::optional<std::string> (*reason)(const Scene& scene, const SceneContent& content);
};

/// Every effect known, in a fixed order.
const std::vector<Effect>& effect_registry();

struct ActiveEffect {
    std::string_view name;
    std::string_view macro;
    std::string reason;
};

std::vector<ActiveEffect> active_effects(const Scene& scene, const SceneContent& content);

}  // namespace farlight
