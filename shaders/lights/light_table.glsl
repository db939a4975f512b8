// The table of lights (layout: shared/scene_layout.h).
#pragma once
#include "geometry/scene.glsl"

#ifdef FX_LIGHTS
uniform usamplerBuffer lights;

struct Light {
    uint kind;
    bool emits_both_sides;
    uint texture_index;  // + 1, 0: none
    float pmf;           // of choosing it; with a tree, of asking the tree
    float area;          // one side [m^2]
    vec3 p0;
    vec3 edge_u;
    vec3 edge_v;
    vec3 radiance;
    uint trail;  // to its leaf in the tree
};

Light load_light(uint index)
{
    const int at = int(index) * LIGHT_TEXELS;
    const uvec4 a = fetch_attribute(lights, at);
    const uvec4 e = fetch_attribute(lights, at + 4);
    return Light(a.x & LIGHT_KIND_MASK, (a.x & LIGHT_EMITS_BOTH_SIDES) != 0u, a.y, uintBitsToFloat(a.z),
        uintBitsToFloat(a.w), uintBitsToFloat(fetch_attribute(lights, at + 1).xyz),
        uintBitsToFloat(fetch_attribute(lights, at + 2).xyz), uintBitsToFloat(fetch_attribute(lights, at + 3).xyz),
        uintBitsToFloat(e.xyz), e.w);
}

float load_light_pmf(uint index) { return uintBitsToFloat(fetch_attribute(lights, int(index) * LIGHT_TEXELS).z); }

// Bits of the probability of keeping `slot` of the alias table, and the light to take otherwise.
uvec2 light_alias(uint slot)
{
    const int at = int(slot) * LIGHT_TEXELS;
    return uvec2(fetch_attribute(lights, at + 1).w, fetch_attribute(lights, at + 2).w);
}
#endif
