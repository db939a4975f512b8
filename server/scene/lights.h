// Area lights: what emits, how strongly, and a table to pick one with probability proportional to
// its power.
#pragma once

#include "server/scene/scene.h"
#include "server/scene/texels.h"

#include <cstdint>
#include <span>
#include <vector>

namespace farlight {

/// One emitter in world space. Sphere: p0 is the center, edge_u.x the radius.
struct Light {
    std::uint32_t kind = 0;  ///< LIGHT_* of shaders/shared/scene_layout.h.
    std::uint32_t material = 0;
    glm::vec3 p0{0};
    glm::vec3 edge_u{0};
    glm::vec3 edge_v{0};
    float area = 0;  ///< [m^2], one side.
    glm::vec3 radiance{0};
    bool emits_both_sides = false;
    double power =
        0;  ///< Luminance of the emitted flux [W]: pi * Le * area, twice that if both sides emit.
    float pmf = 0;  ///< Probability that the alias table picks this light; sums to 1.
    float alias_threshold =
        1;  ///< Keep this light if the second random number is below, else take `alias`.
    std::uint32_t alias = 0;
};

/// Shapes as lights, without material and power.
Light light_of(const Sphere& sphere);
Light light_of_quad(const glm::vec3& p0, const glm::vec3& edge_u, const glm::vec3& edge_v);
Light light_of_triangle(const glm::vec3& p0, const glm::vec3& edge_u, const glm::vec3& edge_v);

/// Luminance of linear Rec. 709 RGB.
double luminance(const glm::dvec3& rgb);

/// Luminance of the flux the light emits [W]; 0 for what has no area or emits nothing, which must
/// not become a light.
double light_power(const Light& light, const Material& material);

/// Vose's alias method over `power`, in double precision. Every light must have power > 0.
/// Source: Vose 1991, "A linear algorithm for generating random numbers with a given distribution".
void fill_alias_table(std::span<Light> lights);

/// LIGHT_TEXELS a light (shaders/shared/scene_layout.h).
Texels pack_lights(std::span<const Light> lights);

}  // namespace farlight
