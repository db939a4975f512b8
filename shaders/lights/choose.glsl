// Which light to sample, and how likely each is chosen: by power, or among many by a tree.
#pragma once
#include "lib/frame.glsl"
#include "lights/light_table.glsl"
#include "lights/light_tree.glsl"

#ifdef FX_LIGHTS
// A light with probability proportional to its power. Source: Vose 1991 (alias method).
uint choose_by_power(float u)
{
    const float scaled = u * float(frame.light_count);
    const uint slot = min(uint(scaled), max(frame.light_count, 1u) - 1u);
    const uvec2 alias = light_alias(slot);
    return scaled - float(slot) < uintBitsToFloat(alias.x) ? slot : alias.y;
}

#ifdef FX_LIGHT_TREE
// The tree, or one of the lights without a place, with probability proportional to their power.
uint choose_by_tree(vec3 position, vec3 normal, vec4 u, out float pmf)
{
    const uvec4 header = fetch_attribute(light_tree, 0);
    float left = u.x - uintBitsToFloat(header.z);
    uint light = descend_light_tree(position, normal, u, pmf);
    pmf *= uintBitsToFloat(header.z);
    const int list = LIGHT_TREE_HEADER_TEXELS + int(header.x) * LIGHT_NODE_TEXELS;
    uint i = 0u;
    while (left >= 0.0 && i < header.y) {
        light = fetch_attribute(light_tree, list + int(i)).x;
        pmf = load_light_pmf(light);
        left -= pmf;
        ++i;
    }
    return light;
}
#endif

// A light for a surface, and the probability that it is this one.
uint choose_light(vec3 position, vec3 normal, vec4 u, out float pmf)
{
#ifdef FX_LIGHT_TREE
    if (asks_light_tree())
        return choose_by_tree(position, normal, u, pmf);
#endif
    const uint light = choose_by_power(u.x);
    pmf = load_light_pmf(light);
    return light;
}

// The probability with which choose_light() chooses `light`, which has a place.
float light_pmf(Light light, vec3 position, vec3 normal)
{
    float pmf = light.pmf;
#ifdef FX_LIGHT_TREE
    if (asks_light_tree())
        pmf *= light_tree_pmf(position, normal, light.trail);
#endif
    return pmf;
}
#endif
