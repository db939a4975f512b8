// Materials that absorb nothing: what the furnaces and the tests of samplers are made of.
#pragma once

#include "server/scene/scene.h"

namespace farlight::lossless {

inline Material white(float metallic = 0, float roughness = 1)
{
    return {.name = "white", .albedo = glm::vec3(1), .metallic = metallic, .roughness = roughness};
}

inline Material plastic(float roughness)
{
    Material m = white(0, roughness);
    m.specular = 1;
    return m;
}

inline Material glass(float roughness, float ior = 1.5F)
{
    Material m = plastic(roughness);
    m.transmission = 1;
    m.ior = ior;
    return m;
}

inline Material thin_glass(float roughness)
{
    Material m = glass(roughness);
    m.thin_walled = true;
    return m;
}

inline Material coated(Material m, float roughness)
{
    m.clearcoat = 1;
    m.clearcoat_roughness = roughness;
    return m;
}

}  // namespace farlight::lossless
