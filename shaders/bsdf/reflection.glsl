// Reflection by the base layer: a conductor, a dielectric over something diffuse, or a blend. Both share a roughness,
// so they are one lobe whose Fresnel term is blended; the blend is scaled to the sum of both albedos with all scattering
// between the facets, so that the diffuse layer below gets exactly what is left.
//
// Source: glTF 2.0, appendix B; KHR_materials_ior; KHR_materials_specular; compensation: see bsdf/albedo_table.glsl.
#pragma once
#include "bsdf/lobe.glsl"
#include "materials/shaded_material.glsl"

#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR)
struct Reflection {
    vec3 r0;   // reflectance at normal incidence, compensated
    vec3 r90;  // at grazing
    vec3 albedo;
    float alpha;  // 0: a mirror
};

// Reflectance of the dielectric at normal incidence: ior and tint.
vec3 dielectric_f0(ShadedMaterial m, float eta)
{
    return min(fresnel_normal(eta) * m.specular_color, vec3(1.0)) * m.specular;
}

// `opaque` is the part of the surface that is a dielectric over a diffuse layer; `below` is what that lets through.
Reflection make_reflection(ShadedMaterial m, float cos_o, float eta, float opaque, out vec3 below)
{
    Reflection r;
    r.alpha = m.alpha;
    const vec2 table = reflection_albedo_at(cos_o, m.alpha);
    const vec3 f0 = dielectric_f0(m, eta);
    precise const vec3 dielectric = compensated_albedo(table, f0, vec3(m.specular));
    precise const vec3 conductor = compensated_albedo(table, m.albedo, vec3(1.0));
    precise const vec3 blend0 = opaque * f0 + m.metallic * m.albedo;
    precise const vec3 blend90 = vec3(opaque * m.specular + m.metallic);
    precise const vec3 single = single_albedo(table, blend0, blend90);
    r.albedo = opaque * dielectric + m.metallic * conductor;
    precise const vec3 scale = mix(vec3(0.0), r.albedo / single, greaterThan(single, vec3(0.0)));
    r.r0 = blend0 * scale;
    r.r90 = blend90 * scale;
    below = opaque * (1.0 - dielectric);
    return r;
}

vec3 reflectance(Reflection r, float cos_h) { return r.r0 + (r.r90 - r.r0) * schlick_weight(cos_h); }

#ifdef FX_ROUGH_REFLECTION
LobeValue evaluate(Reflection r, vec3 wo, vec3 wi)
{
    float cos_h;
    const vec2 ggx = ggx_reflection(wo, wi, max(r.alpha, GGX_ALPHA_MIN), cos_h);
    const LobeValue v = LobeValue(reflectance(r, cos_h) * ggx.x, ggx.y);
    if (r.alpha > 0.0)
        return v;
    return NO_LOBE_VALUE;
}
#endif

// A direction, which may be below the surface; a mirror's is exact.
vec3 sample_direction(Reflection r, vec3 wo, vec2 u)
{
    vec3 wi = mirrored(wo);
#ifdef FX_ROUGH_REFLECTION
    const vec3 rough = reflected(wo, ggx_sample_visible_normal(wo, max(r.alpha, GGX_ALPHA_MIN), u));
    wi = r.alpha > 0.0 ? rough : wi;
#endif
    return wi;
}
#endif
