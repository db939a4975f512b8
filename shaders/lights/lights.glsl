// All that emits, seen from a shading point: sample one of the lights, or ask how likely a light that was hit would have
// been sampled.
#pragma once
#include "geometry/surface.glsl"
#include "lights/area.glsl"
#include "lights/choose.glsl"
#include "lights/delta.glsl"
#include "lights/environment.glsl"

#ifdef FX_LIGHTS
// A light and a point on it for the surface at `position` whose shading normal is `normal` (0 in a medium).
// u.x chooses the light (a tree's descent hashes u.y and u.w as well), the others what there is to choose of it.
LightSample sample_lights(vec3 position, vec3 normal, vec4 u)
{
    float pmf;
    const Light light = load_light(choose_light(position, normal, u, pmf));
    LightSample s = NO_LIGHT_SAMPLE;
#if defined(FX_POLYGON_LIGHTS) || defined(FX_EMISSIVE_MESHES)
    // A texel's weights are resolved well enough by 12 bits each of the last number.
    const float coarse = floor(u.w * 4096.0) / 4096.0;
    if (is_polygon(light))
        s = sample_polygon_light(light, position, u.yz, vec2(coarse, (u.w - coarse) * 4096.0));
#endif
#ifdef FX_SPHERE_LIGHTS
    if (light.kind == LIGHT_SPHERE)
        s = sample_sphere_light(light, position, u.yz);
#endif
#ifdef FX_DISK_LIGHTS
    if (light.kind == LIGHT_DISK)
        s = sample_disk_light(light, position, u.yz);
#endif
#ifdef FX_DELTA_LIGHTS
    if (is_delta(light))
        s = sample_delta_light(light, position);
#endif
#ifdef FX_ENVIRONMENT_MAP
    if (light.kind == LIGHT_ENVIRONMENT)
        s = sample_environment(u.yzw);
#endif
    s.pdf = pmf > 0.0 ? s.pdf * pmf : 0.0;
    return s;
}

// The density per solid angle with which sample_lights(position, normal) finds the point `hit_position` of light
// `index`, where the light's geometric normal is `hit_normal` (either side).
float light_pdf(uint index, vec3 position, vec3 normal, vec3 hit_position, vec3 hit_normal)
{
    const Light light = load_light(index);
    const float pmf = light_pmf(light, position, normal);
    return pmf > 0.0 ? pmf * area_light_pdf(light, position, hit_position, hit_normal) : 0.0;
}
#endif
