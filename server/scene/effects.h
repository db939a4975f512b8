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

struct Effect {
    std::string_view name;  ///< As shown by `farlight info`.
    std::string_view macro;  ///< Defined in shaders when the scene calls for the effect.
    /// Why the scene calls for it ("4 spheres, first 'ground'"), or nothing.
    std::optional<std::string> (*reason)(const Scene& scene);
};

/// Every effect known, in a fixed order.
const std::vector<Effect>& effect_registry();

struct ActiveEffect {
    std::string_view name;
    std::string_view macro;
    std::string reason;
};

std::vector<ActiveEffect> active_effects(const Scene& scene);

}  // namespace farlight
