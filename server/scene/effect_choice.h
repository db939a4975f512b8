// EffectChoice: the setting `effects`: which effects a picture's programs hold.
#pragma once

#include "server/scene/effects.h"

namespace farlight {

struct EffectChoice {
    enum class Kind : std::uint8_t {
        kAuto,  ///< As few as the scene allows, as soon as they are compiled.
        kGeneral,  ///< All.
        kList,  ///< Those of `mask`, compiled before the next frame.
    };
    Kind kind = Kind::kAuto;
    EffectMask mask;

    bool operator==(const EffectChoice&) const = default;
};

/// "auto", "general", or effects by name with all they need: "fog,lens"; "" and spaces after commas
/// are fine. Throws std::invalid_argument naming what is none of these, or is controlled by
/// another setting because nothing of it is compiled.
EffectChoice parse_effect_choice(std::string_view text);
/// The same the other way.
std::string to_text(const EffectChoice& choice);

/// Why programs with this choice cannot draw a scene that calls for `effects`, or nothing:
/// "'fog' is missing: medium 'haze', sigma_t 0.02 1/m; ...".
std::optional<std::string> what_is_missing(
    const EffectChoice& choice, const std::vector<ActiveEffect>& effects);

}  // namespace farlight
