// A material at a point of a surface: constants times textures, and the shading normal after the normal map.
#pragma once
#include "geometry/surface.glsl"
#include "materials/normal_map.glsl"
#include "materials/shaded_material.glsl"
#include "textures/texture.glsl"

// How textures are read: at the first hit filtered, later one random texel whose mean is the filtered value.
struct TextureLookup {
    float log2_width;  // of the ray's cone on the surface [m]
    bool stochastic;
    vec3 u;  // random numbers of a stochastic look-up
};

// A material on its way from constants to what is seen.
struct MaterialDraft {
    uint flags;
    vec3 albedo;
    vec3 emission;
    float metallic;
    float roughness;
    float specular;
    vec3 specular_color;
    float transmission;
    float clearcoat;
    float clearcoat_roughness;
    vec3 normal;  // in tangent space
    vec3 clearcoat_normal;
};

vec4 material_texel(uint material, int which)
{
    return uintBitsToFloat(texelFetch(materials, int(material) * MATERIAL_TEXELS + which));
}

bool has_map(uint flags, int map) { return ((flags >> MATERIAL_MAP_SHIFT) & (1u << map)) != 0u; }

#ifdef FX_TEXTURES
vec4 look_up(Surface s, int map, TextureLookup l)
{
    const int at = int(s.material) * MATERIAL_TEXELS + MATERIAL_TEXTURES + map * TEXTURE_TEXELS;
    const TextureRef t = unpack_texture(texelFetch(materials, at), texelFetch(materials, at + 1));
    const vec2 uv = t.uv_set == 0 ? s.uv[0] : s.uv[1];
    const float lod = l.log2_width + (t.uv_set == 0 ? s.log2_uv_per_metre.x : s.log2_uv_per_metre.y);
    if (l.stochastic)
        return texture_stochastic(t, uv, lod, l.u);
    return texture_filtered(t, uv, lod);
}

// One texture's part; `normal_scales`: of the base and of the coat. Only what is compiled reaches the material.
void apply_map(inout MaterialDraft d, int map, vec4 texel, vec2 normal_scales)
{
    d.albedo *= map == MAP_ALBEDO ? texel.rgb : vec3(1.0);
    d.emission *= map == MAP_EMISSION ? texel.rgb : vec3(1.0);
    d.specular_color *= map == MAP_SPECULAR_COLOR ? texel.rgb : vec3(1.0);
    d.roughness *= map == MAP_METALLIC_ROUGHNESS ? texel.g : 1.0;
    d.metallic *= map == MAP_METALLIC_ROUGHNESS ? texel.b : 1.0;
    d.specular *= map == MAP_SPECULAR ? texel.a : 1.0;
    d.transmission *= map == MAP_TRANSMISSION ? texel.r : 1.0;
    d.clearcoat *= map == MAP_CLEARCOAT ? texel.r : 1.0;
    d.clearcoat_roughness *= map == MAP_CLEARCOAT_ROUGHNESS ? texel.g : 1.0;
#ifdef FX_NORMAL_MAPS
    d.normal = map == MAP_NORMAL ? decoded_normal(texel.rgb, normal_scales.x) : d.normal;
    d.clearcoat_normal = map == MAP_CLEARCOAT_NORMAL ? decoded_normal(texel.rgb, normal_scales.y) : d.clearcoat_normal;
#endif
}

// A loop over the textures that the material has, which on most is none.
void apply_maps(inout MaterialDraft d, Surface s, TextureLookup lookup, vec2 normal_scales)
{
    uint left = d.flags >> MATERIAL_MAP_SHIFT;
    while (left != 0u) {
        const int map = findLSB(left);
        left &= left - 1u;
        apply_map(d, map, look_up(s, map, lookup), normal_scales);
    }
}
#endif

MaterialDraft drafted(Surface s, TextureLookup lookup)
{
    const vec4 albedo = material_texel(s.material, MATERIAL_ALBEDO);
    const vec4 base = material_texel(s.material, MATERIAL_BASE);
    const vec4 specular = material_texel(s.material, MATERIAL_SPECULAR);
    const vec4 coat = material_texel(s.material, MATERIAL_COAT);
    MaterialDraft d;
    d.flags = floatBitsToUint(albedo.w);
    d.albedo = albedo.rgb;
    d.emission = material_texel(s.material, MATERIAL_EMISSION).rgb;
    d.metallic = base.x;
    d.roughness = base.y;
    d.specular = base.z;
    d.specular_color = specular.rgb;
    d.transmission = specular.w;
    d.clearcoat = coat.x;
    d.clearcoat_roughness = coat.y;
    d.normal = d.clearcoat_normal = vec3(0.0, 0.0, 1.0);
#ifdef FX_VERTEX_COLORS
    d.albedo *= s.color.rgb;
#endif
#ifdef FX_TEXTURES
    apply_maps(d, s, lookup, vec2(coat.z, material_texel(s.material, MATERIAL_COAT_NORMAL).x));
#endif
    return d;
}

// The material of surface `s` seen along unit `wo`, which points away from the surface.
ShadedMaterial material_at(Surface s, vec3 wo, TextureLookup lookup)
{
    const MaterialDraft d = drafted(s, lookup);
    ShadedMaterial m;
    m.albedo = d.albedo;
    m.emission = s.front || (d.flags & MATERIAL_EMITS_BOTH_SIDES) != 0u ? d.emission : vec3(0.0);
    m.shading_normal = s.shading_normal;
#ifdef FX_NORMAL_MAPS
    if (has_map(d.flags, MAP_NORMAL))
        m.shading_normal = bent_normal(mapped_normal(s, d.normal), s.geometric_normal, wo);
#endif
#ifdef FX_UNLIT
    m.unlit = (d.flags & MATERIAL_UNLIT) != 0u;
    m.emission += m.unlit ? m.albedo : vec3(0.0);
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    m.metallic = d.metallic;
    m.alpha = alpha_of(d.roughness, has_map(d.flags, MAP_METALLIC_ROUGHNESS));
    m.specular = d.specular;
    m.ior = material_texel(s.material, MATERIAL_BASE).w;
    m.specular_color = d.specular_color;
#endif
#ifdef FX_DIELECTRIC
    const vec4 inside = material_texel(s.material, MATERIAL_INSIDE);
    m.transmission = d.transmission;
    m.thin_walled = (d.flags & MATERIAL_THIN_WALLED) != 0u;
    m.absorption = inside.rgb;
    m.priority = floatBitsToInt(inside.w);
#endif
#ifdef FX_CLEARCOAT
    // A coat is on the outside.
    m.clearcoat = s.front || !is_transparent(m) ? d.clearcoat : 0.0;
    m.clearcoat_alpha = alpha_of(d.clearcoat_roughness, has_map(d.flags, MAP_CLEARCOAT_ROUGHNESS));
    m.clearcoat_normal = s.shading_normal;
#ifdef FX_NORMAL_MAPS
    if (has_map(d.flags, MAP_CLEARCOAT_NORMAL))
        m.clearcoat_normal = bent_normal(mapped_normal(s, d.clearcoat_normal), s.geometric_normal, wo);
#endif
#endif
    return m;
}
