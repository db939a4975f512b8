// The scene's buffer textures (layout: shared/scene_layout.h) and typed access to them.
#pragma once
#include "shared/scene_layout.h"

uniform usamplerBuffer bvh_nodes;
uniform usamplerBuffer primitives;
uniform usamplerBuffer materials;
#ifdef FX_TRIANGLES
uniform usamplerBuffer triangles;
#endif
#ifdef FX_SPHERES
uniform usamplerBuffer spheres;
#endif

struct Primitive {
    uint object;
    uint material;
    uint light;  // index + 1, 0: none
    bool smooth_normals;
};

Primitive load_primitive(uint index)
{
    const uvec4 texel = texelFetch(primitives, int(index) * PRIMITIVE_TEXELS);
    return Primitive(texel.x, texel.y, texel.z, texel.w != 0u);
}

struct Material {
    vec3 albedo;
    vec3 emission;
    bool emits_both_sides;
};

Material load_material(uint index)
{
    const uvec4 texel = texelFetch(materials, int(index) * MATERIAL_TEXELS);
    const uvec4 emission = texelFetch(materials, int(index) * MATERIAL_TEXELS + 1);
    return Material(uintBitsToFloat(texel.xyz), uintBitsToFloat(emission.xyz),
        (texel.w & MATERIAL_EMITS_BOTH_SIDES) != 0u);
}
