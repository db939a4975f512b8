// All that emits, seen from a shading point: sample one of the lights, or ask how likely a light that was hit would have
// been sampled.
#pragma once
#include "geometry/surface.glsl"
#include "lights/area.glsl"
#include "lights/environment.glsl"

#ifdef FX_LIGHTS
// A light and a point on it for the surface at `position` whose shading normal is `normal` (0 in a medium).
// u.x chooses the light, u.yz the point, u.w the texel of its texture.
LightSample sample_lights(vec3 position, vec3 normal, vec4 u)
{
    const Light light = choose_light(u.x);
    LightSample s = sample_area_light(light, position, u.yz);
    s.pdf *= light.pmf;
    return s;
}

// The density per solid angle with which sample_lights(position, normal) finds the point `hit_position` of light
// `index`, where the light's geometric normal is `hit_normal` (either side).
float light_pdf(uint index, vec3 position, vec3 normal, vec3 hit_position, vec3 hit_normal)
{
    const Light light = load_light(index);
    return light.pmf * area_light_pdf(light, position, hit_position, hit_normal);
}
#endif

// Radiance leaving an emitter towards where it was seen from.
vec3 emitted(Material material, bool front)
{
    return front || material.emits_both_sides ? material.emission : vec3(0.0);
}
