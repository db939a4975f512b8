// A material at a point of a surface: constants times textures, and the shading normal after the normal map.
#pragma once
#include "geometry/surface.glsl"
#include "materials/shaded_material.glsl"

// How textures are read: at the first hit filtered, later one random texel whose mean is the filtered value.
struct TextureLookup {
    float log2_width;  // of the ray's cone on the surface [m]
    bool stochastic;
    vec3 u;  // random numbers of a stochastic look-up
};

vec4 material_texel(uint material, int which)
{
    return uintBitsToFloat(texelFetch(materials, int(material) * MATERIAL_TEXELS + which));
}

// GGX alpha of a constant perceptual roughness.
float alpha_of(float roughness) { return roughness > MIRROR_ROUGHNESS ? roughness * roughness : 0.0; }

// The material of surface `s` seen along unit `wo`, which points away from the surface.
ShadedMaterial material_at(Surface s, vec3 wo, TextureLookup lookup)
{
    const uint material = s.material;
    const vec4 albedo = material_texel(material, MATERIAL_ALBEDO);
    const uint flags = floatBitsToUint(albedo.w);
    ShadedMaterial m;
    m.albedo = albedo.rgb;
    const bool emits = s.front || (flags & MATERIAL_EMITS_BOTH_SIDES) != 0u;
    m.emission = emits ? material_texel(material, MATERIAL_EMISSION).rgb : vec3(0.0);
    m.shading_normal = s.shading_normal;
#ifdef FX_UNLIT
    m.unlit = (flags & MATERIAL_UNLIT) != 0u;
    m.emission += m.unlit ? m.albedo : vec3(0.0);
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    const vec4 base = material_texel(material, MATERIAL_BASE);
    const vec4 specular = material_texel(material, MATERIAL_SPECULAR);
    m.metallic = base.x;
    m.alpha = alpha_of(base.y);
    m.specular = base.z;
    m.ior = base.w;
    m.specular_color = specular.rgb;
#endif
#ifdef FX_DIELECTRIC
    const vec4 inside = material_texel(material, MATERIAL_INSIDE);
    m.transmission = specular.w;
    m.thin_walled = (flags & MATERIAL_THIN_WALLED) != 0u;
    m.absorption = inside.rgb;
    m.priority = floatBitsToInt(inside.w);
#endif
#ifdef FX_CLEARCOAT
    const vec4 coat = material_texel(material, MATERIAL_COAT);
    m.clearcoat = coat.x;
    m.clearcoat_alpha = alpha_of(coat.y);
    m.clearcoat_normal = s.shading_normal;
#endif
    return m;
}
