// What a camera may be: from scene files, and for those that are placed for a scene without one.
#pragma once

#include "server/scene/scene.h"

#include <algorithm>
#include <limits>

namespace farlight {

/// As in the scene file's schema and in the protocol [degrees].
inline constexpr double kNarrowestFov = 0.001;
inline constexpr double kWidestFov = 179;

/// As near as two positions can lie before rounding decides where the camera looks.
inline double nearest_target(const glm::dvec3& position, const glm::dvec3& target)
{
    return 64 * std::numeric_limits<double>::epsilon()
        * std::max(glm::length(position), glm::length(target));
}

/// From a camera to a target that is `distance` [m] off by what the scene says. What is a point,
/// or so small that squares of its size vanish, is looked at from 1 m.
inline double usable_distance(double distance)
{
    return distance >= static_cast<double>(std::numeric_limits<float>::min()) ? distance : 1;
}

}  // namespace farlight
