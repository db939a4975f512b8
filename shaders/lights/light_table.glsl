// The table of lights (layout: shared/scene_layout.h) and the choice of one by power.
#pragma once
#include "geometry/scene.glsl"
#include "lib/frame.glsl"

#ifdef FX_LIGHTS
uniform usamplerBuffer lights;

struct Light {
    uint kind;
    bool emits_both_sides;
    uint texture_index;  // + 1, 0: none
    float pmf;           // of choosing it
    float area;          // one side [m^2]
    vec3 p0;
    float alias_threshold;
    vec3 edge_u;
    uint alias_index;
    vec3 edge_v;
    vec3 radiance;
};

Light load_light(uint index)
{
    const int at = int(index) * LIGHT_TEXELS;
    const uvec4 a = fetch_attribute(lights, at);
    const uvec4 b = fetch_attribute(lights, at + 1);
    const uvec4 c = fetch_attribute(lights, at + 2);
    const uvec4 d = fetch_attribute(lights, at + 3);
    const uvec4 e = fetch_attribute(lights, at + 4);
    return Light(a.x & LIGHT_KIND_MASK, (a.x & LIGHT_EMITS_BOTH_SIDES) != 0u, a.y, uintBitsToFloat(a.z),
        uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), c.w,
        uintBitsToFloat(d.xyz), uintBitsToFloat(e.xyz));
}

// A light with probability Light.pmf. Source: Vose 1991 (alias method).
Light choose_light(float u)
{
    const float scaled = u * float(frame.light_count);
    const uint slot = min(uint(scaled), frame.light_count - 1u);
    const Light light = load_light(slot);
    if (scaled - float(slot) < light.alias_threshold || light.alias_index == slot)
        return light;
    return load_light(light.alias_index);
}
#endif
