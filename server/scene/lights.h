// Lights as the GPU samples them: what emits, where, how strongly.
#pragma once

#include "server/scene/scene.h"

#include <cstdint>

namespace farlight {

/// One emitter in world space. What p0 and the edges mean follows from the kind
/// (shaders/shared/scene_layout.h).
struct Light {
    std::uint32_t kind = 0;  ///< LIGHT_*.
    std::uint32_t object = kNone;  ///< That emits; none for punctual lights and the environment.
    std::uint32_t face = 0;  ///< Of the object's mesh; 0 for other shapes.
    bool mirrored = false;  ///< The object's transform turns the face's winding round.
    glm::vec3 p0{0};
    glm::vec3 edge_u{0};
    glm::vec3 edge_v{0};
    float area = 0;  ///< [m^2], one side.
    bool emits_both_sides = false;
    glm::vec3 radiance{0};  ///< Before textures. Point, spot: intensity; directional: irradiance.
    double mean_luminance = 0;  ///< Of the radiance, over the area and after textures.
    double power = 0;  ///< Luminance of the flux into the scene [W].
    float pmf = 0;  ///< Probability of being chosen, the same everywhere.
};

/// Shapes as lights, without material and power.
Light light_of(const Sphere& sphere);
Light light_of(const Disk& disk);
Light light_of_quad(const glm::vec3& p0, const glm::vec3& edge_u, const glm::vec3& edge_v);
Light light_of_triangle(const glm::vec3& p0, const glm::vec3& edge_u, const glm::vec3& edge_v);
/// With its strength; `world_from_node` where it hangs on a node, else the identity. Where a node
/// leaves it no direction, a light that needs one keeps that of its rest and goes out.
Light light_of(const PunctualLight& light, const glm::dmat4& world_from_node);

/// Luminance of linear Rec. 709 RGB.
double luminance(const glm::dvec3& rgb);

/// Luminance of the flux that leaves the light [W], from radiance and area; of a directional light
/// and the environment: that reaches a scene of radius `scene_radius`.
double light_power(const Light& light, double scene_radius);

/// Whether an object may be sampled as a light: it emits, and its radiance at a sampled point can
/// be told. It cannot where textures lie on a sphere, or where vertex colours decide what is there;
/// such emitters are met by following the BSDF alone.
bool is_sampled(const Scene& scene, const Object& object);

}  // namespace farlight
