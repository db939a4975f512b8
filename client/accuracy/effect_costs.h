// What the effects that a scene calls for cost and bring in: the scene with each of them against
// the scene without it, by an edit. Effects that nothing can be edited out of (triangles, lights)
// are listed with the reason alone.
#pragma once

#include "client/accuracy/errors.h"

namespace farlight::client {

/// A patch that takes the effect out of the document; null where there is no such patch.
nlohmann::json removal_of(const std::string& effect, const nlohmann::json& document);

struct EffectsPlan {
    int frames = 4;  ///< Timed, of each of four turns a side.
    int seeds = 4;  ///< Of the noise, at least 2.
    Settings settings;
    SweepPoint filtered;  ///< Timed.
    SweepPoint raw;  ///< Whose noise is looked at.
};

/// Whose effects are taken out, and which pixels of its picture count.
struct EffectScene {
    const nlohmann::json& document;
    Mask counts;
};

/// "general": the frame with general programs and with the scene's own; "rows": an effect each, as
/// REPORT.md describes them.
nlohmann::json measure_effects(
    Rig& rig, const EffectsPlan& plan, const EffectScene& scene, Progress& progress);

/// Variance over pictures of different seeds, relative to their mean: mean(Var x / (E[x]^2 +
/// 0.01)) over the pixels that count.
double relative_noise(const std::vector<std::vector<float>>& pictures, Mask counts = {});

}  // namespace farlight::client
