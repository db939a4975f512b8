// Directional albedo of rough interfaces, from tables that the host integrates (server/scene/albedo_tables.cpp) when
// a scene has something rough. Four corners of a cell share a texel, so one gather interpolates in two dimensions.
#pragma once
#include "bsdf/fresnel.glsl"
#include "shared/scene_layout.h"

#if defined(FX_ROUGH_REFLECTION) || defined(FX_CLEARCOAT) || defined(FX_ROUGH_DIELECTRIC)
uniform usamplerBuffer reflection_albedo;

// Place on an axis of `count` nodes over [0, 1]: cell and fraction in it.
void table_place(float x, int count, out int cell, out float fraction)
{
    precise const float at = clamp(x, 0.0, 1.0) * float(count - 1);
    cell = min(int(at), count - 2);
    fraction = at - float(cell);
}

float table_value(uvec4 corners, float x, float y)
{
    precise const vec4 c = uintBitsToFloat(corners);
    precise const float value = mix(mix(c.x, c.y, x), mix(c.z, c.w, x), y);
    return value;
}

// Most of what changes with the cosine changes where it is about alpha, and towards the horizon.
float albedo_coordinate(float cos_o, float alpha)
{
    precise const float t = cos_o * (1.0 + alpha) / (cos_o + alpha);
    precise const float x = 0.5 * (t + sqrt(t));
    return x;
}

// Of GGX alone: x without Fresnel, y the mean of Schlick's weight over what is reflected. A delta lobe has alpha 0.
vec2 reflection_albedo_at(float cos_o, float alpha)
{
    int i, j;
    float x, y;
    table_place(sqrt(alpha), ALBEDO_NODES, j, y);
    table_place(albedo_coordinate(cos_o, alpha), ALBEDO_NODES, i, x);
    const float albedo = table_value(texelFetch(reflection_albedo, j * (ALBEDO_NODES - 1) + i), x, y);
    table_place(sqrt(cos_o), ALBEDO_NODES, i, x);
    const int schlick_part = (ALBEDO_NODES - 1) * (ALBEDO_NODES - 1);
    precise const float q = 1.0 - cos_o
        + table_value(texelFetch(reflection_albedo, schlick_part + j * (ALBEDO_NODES - 1) + i), x, y);
    // A scene without anything rough has no table to read.
    return alpha > 0.0 && albedo > 0.0 ? vec2(albedo, (q * q) * (q * q) * q) : vec2(1.0, schlick_weight(cos_o));
}
#else
// Without anything rough all there is are delta lobes.
vec2 reflection_albedo_at(float cos_o, float alpha) { return vec2(1.0, schlick_weight(cos_o)); }
#endif

// Albedo of single scattering with Schlick's Fresnel term between f0 and f90.
vec3 single_albedo(vec2 table, vec3 f0, vec3 f90) { return table.x * (f0 + (f90 - f0) * table.y); }

// The same with all scattering between the facets, which each reflect f0 on average.
// Source: Turquin 2019, "Practical multiple scattering compensation for microfacet models", eq. 16. Chosen over Kulla
// and Conty 2017 because it needs no lobe of its own, so no other sampler and no noise, and is exact at every angle;
// the price is reciprocity, which tracing from the camera alone never uses.
vec3 compensated_albedo(vec2 table, vec3 f0, vec3 f90)
{
    return single_albedo(table, f0, f90) * (1.0 + f0 * (1.0 / table.x - 1.0));
}

#ifdef FX_ROUGH_DIELECTRIC
uniform usamplerBuffer dielectric_albedo;

// What a rough interface reflects and transmits together in single scattering.
float dielectric_albedo_at(float cos_o, float alpha, float eta)
{
    int i, j, k;
    float x, y, z;
    const float contrast = (eta - 1.0) / (eta + 1.0);
    table_place(albedo_coordinate(cos_o, alpha), DIELECTRIC_NODES, i, x);
    table_place(sqrt(alpha), DIELECTRIC_NODES, j, y);
    table_place(contrast / (2.0 * DIELECTRIC_CONTRAST) + 0.5, DIELECTRIC_ETA_NODES, k, z);
    const int cells = (DIELECTRIC_NODES - 1) * (DIELECTRIC_NODES - 1);
    const int at = k * cells + j * (DIELECTRIC_NODES - 1) + i;
    const float lower = table_value(texelFetch(dielectric_albedo, at), x, y);
    const float upper = table_value(texelFetch(dielectric_albedo, at + cells), x, y);
    precise const float albedo = mix(lower, upper, z);
    return albedo > 0.0 ? albedo : 1.0;
}
#endif
