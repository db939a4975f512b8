// Environment maps made by formula, and what they show in double precision (scene.h has where what
// lies). Of the red channel: all three are equal.
#pragma once

#include "server/scene/scene.h"

#include <functional>
#include <memory>
#include <vector>

namespace farlight::lab {

/// A texel shows `radiance` of the way that its middle lies.
std::shared_ptr<EnvironmentMap> map_of(std::uint32_t width, std::uint32_t height,
    const std::function<double(const glm::dvec3&)>& radiance);

/// Every texel its own, in [0, 1). Seeded.
std::shared_ptr<EnvironmentMap> random_map(std::uint32_t width, std::uint32_t height);

/// Bilinear; u, v in [0, 1].
double radiance_at(const EnvironmentMap& map, double u, double v);
double radiance_along(const EnvironmentMap& map, const glm::dvec3& way);

/// Over all directions, by quadrature.
double integral_of(const EnvironmentMap& map);

/// Unit ways along axes and exactly up and down, zeros of either sign, beside poles and the seam,
/// and anywhere; w is 0.
std::vector<glm::vec4> ways_to_ends();

}  // namespace farlight::lab
