// The cones that a spot light can have.
#pragma once

#include "server/scene/scene.h"

#include <algorithm>
#include <numbers>

namespace farlight {

/// Brings the light's cones into range: whether that changed them. An edge without width would be a
/// hard one: a thousandth of the cone stands for it.
inline bool clamp_cones(PunctualLight& light)
{
    const double inner = light.inner_cone;
    const double outer = light.outer_cone;
    light.outer_cone = std::clamp(outer, 1e-3, std::numbers::pi / 2);
    light.inner_cone = std::clamp(inner, 0.0, 0.999 * light.outer_cone);
    return light.inner_cone != inner || light.outer_cone != outer;
}

}  // namespace farlight
