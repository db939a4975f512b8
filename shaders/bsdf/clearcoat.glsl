// A clear layer of index 1.5 over everything, with its own roughness and normal; what it reflects does not get below.
//
// Source: KHR_materials_clearcoat. Differs: what is below is attenuated by the coat's directional albedo, not by its
// Fresnel term at one angle, so nothing is lost; the emission below is not attenuated.
#pragma once
#include "bsdf/lobe.glsl"
#include "lib/sampling.glsl"
#include "materials/shaded_material.glsl"

#ifdef FX_CLEARCOAT
const float COAT_F0 = 0.04;

struct Clearcoat {
    mat3 frame;  // local from the coat's own
    float r0;
    float r90;
    float albedo;
    float alpha;  // 0: a mirror
};

Clearcoat make_clearcoat(ShadedMaterial m, vec3 normal, vec3 wo)
{
    Clearcoat c;
    c.frame = basis_around(normal);
    c.alpha = m.clearcoat_alpha;
    const vec2 table = reflection_albedo_at(above_horizon(wo * c.frame).z, c.alpha);
    precise const float scale = m.clearcoat * (1.0 + COAT_F0 * (1.0 / table.x - 1.0));
    c.r0 = scale * COAT_F0;
    c.r90 = scale;
    precise const float albedo = table.x * (c.r0 + (c.r90 - c.r0) * table.y);
    c.albedo = albedo;
    return c;
}

float reflectance(Clearcoat c, float cos_h) { return c.r0 + (c.r90 - c.r0) * schlick_weight(cos_h); }

LobeValue evaluate(Clearcoat c, vec3 wo, vec3 wi)
{
    float cos_h;
    const vec2 ggx
        = ggx_reflection(above_horizon(wo * c.frame), wi * c.frame, max(c.alpha, GGX_ALPHA_MIN), cos_h);
    const LobeValue v = LobeValue(vec3(reflectance(c, cos_h) * ggx.x), ggx.y);
    if (c.alpha > 0.0)
        return v;
    return NO_LOBE_VALUE;
}

vec3 sample_direction(Clearcoat c, vec3 wo, vec2 u)
{
    const vec3 w = above_horizon(wo * c.frame);
    const vec3 rough = reflected(w, ggx_sample_visible_normal(w, max(c.alpha, GGX_ALPHA_MIN), u));
    return c.frame * (c.alpha > 0.0 ? rough : mirrored(w));
}
#endif
