// What colours and materials make of light: the questions to which all that asks must get the same
// answer.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

inline bool is_black(const glm::vec3& color)
{
    return !(color.x > 0 || color.y > 0 || color.z > 0);
}

/// Whether a layer of it reflects, sharply or roughly. A black conductor does: at grazing angles
/// all of the light, whatever its F0.
inline bool is_glossy(const Material& m)
{
    return !m.unlit && (m.metallic > 0 || m.specular > 0 || m.transmission > 0 || m.clearcoat > 0);
}

/// Whether no ray ever finds it there: nothing is drawn of it.
inline bool is_all_hole(const Material& m)
{
    return m.alpha_mode == AlphaMode::kBlend && !(m.opacity > 0);
}

/// Whether it sends any light on.
inline bool scatters(const Material& m)
{
    return is_glossy(m) || (!m.unlit && !is_black(m.albedo));
}

}  // namespace farlight
