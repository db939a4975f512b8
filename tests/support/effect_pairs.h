// For every effect of the registry a pair of scenes, without and with it, and what it leaves in
// programs, memory and passes: what the tests of effects are made from.
#pragma once

#include "server/scene/scene.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

using SceneChange = std::function<void(Scene&)>;

struct EffectPair {
    std::string_view effect;
    SceneChange without;  ///< What both scenes have besides lit_scene().
    SceneChange with;  ///< What calls for the effect.
    /// Every trace that the effect leaves: "uniform NAME" in a program, "buffer NAME" of the scene,
    /// "texture NAME" of a view, "pass NAME" of a frame, and "code WORD" that is left of the
    /// shaders when all else is compiled out. Regular expressions; of `(a|b)` both are left.
    std::vector<const char*> traces;
    /// Effects that the second scene cannot but gain with it.
    std::vector<std::string_view> along = {};
};

/// A row an effect of the registry; those that a setting calls for change nothing.
std::vector<EffectPair> effect_pairs();

/// plain() under a grey sky.
Scene lit_scene();

}  // namespace farlight
