// An interface that transmits: smooth or rough, bending light or thin-walled.
//
// Radiance here is basic radiance, L / n^2, so a lossless interface has albedo 1 from both sides. A rough one is scaled
// by its single-scattering albedo, reflection and transmission alike, which gives back what is scattered between the
// facets. A thin wall transmits the mirror image of what its surface reflects.
//
// Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", section 4.2 and 5.2;
// KHR_materials_transmission; Turquin 2019 (compensation).
#pragma once
#include "bsdf/lobe.glsl"
#include "materials/shaded_material.glsl"

#ifdef FX_DIELECTRIC
struct Interface {
    vec3 base;    // reflectance is base + slope * Fresnel, but 1 under total internal reflection
    vec3 slope;
    vec3 tint;    // of what is transmitted
    float weight; // part of the surface, compensated
    float albedo; // estimate of what it scatters, for choosing it
    float eta;    // index behind over before
    float alpha;  // 0: smooth
    bool thin;
};

// Where the half vector of a refracted pair, of length about |eta - 1|, is known to fewer than 5 % of alpha (3 ulp),
// the interface bends nothing and is treated as smooth.
const float REFRACTION_RESOLUTION = 3.8146973e-6;

// Reflectance at a facet that is met at cosine `cos_h`.
vec3 reflectance(Interface s, float cos_h)
{
    const float eta = s.thin ? max(s.eta, 1.0 / s.eta) : s.eta;  // a wall is met from outside on either side
    const float f = fresnel_dielectric(cos_h, eta);
    precise const vec3 weighted = clamp(s.base + s.slope * f, 0.0, 1.0);
    if (s.thin)
        return slab_reflectance(weighted);
    return refracted_cosine(cos_h, eta) > 0.0 ? weighted : vec3(1.0);
}

// `part` of the surface is this interface.
Interface make_interface(ShadedMaterial m, float cos_o, float eta, float part)
{
    Interface s;
    s.eta = eta;
    s.thin = m.thin_walled;
    s.alpha = 0.0;
#ifdef FX_ROUGH_DIELECTRIC
    s.alpha = m.alpha * abs(eta - 1.0) > REFRACTION_RESOLUTION ? m.alpha : 0.0;
#endif
    const float f0 = fresnel_normal(eta);
    precise const vec3 at_normal = min(f0 * m.specular_color, vec3(1.0)) * m.specular;
    s.slope = (m.specular - at_normal) / (1.0 - f0);
    s.base = at_normal - s.slope * f0;
    s.tint = m.albedo;
    s.weight = part;
    s.albedo = part * average(s.tint + (1.0 - s.tint) * reflectance(s, cos_o));
#ifdef FX_ROUGH_DIELECTRIC
    const float bent = dielectric_albedo_at(cos_o, s.alpha, eta);
    const float unbent = reflection_albedo_at(cos_o, s.alpha).x;
    precise const float scaled = part / (s.thin ? unbent : bent);
    s.weight = s.alpha > 0.0 ? scaled : part;
#endif
    return s;
}

// Probability of reflecting rather than transmitting where a facet reflects `r`.
float reflection_probability(Interface s, vec3 r)
{
    const float reflect = average(r);
    const float transmit = average((1.0 - r) * s.tint);
    return transmit > 0.0 ? reflect / (reflect + transmit) : 1.0;
}

vec3 refracted(vec3 wo, vec3 h, float eta)
{
    precise const float cos_o = dot(wo, h);
    precise const float cos_t = refracted_cosine(cos_o, eta);
    precise const vec3 wi = (cos_o / eta - cos_t) * h - wo / eta;
    return wi;
}

#ifdef FX_ROUGH_DIELECTRIC
LobeValue evaluate_reflected(Interface s, vec3 wo, vec3 wi, float alpha)
{
    float cos_h;
    const vec2 ggx = ggx_reflection(wo, wi, alpha, cos_h);
    const vec3 r = reflectance(s, cos_h);
    return LobeValue(s.weight * r * ggx.x, reflection_probability(s, r) * ggx.y);
}

LobeValue evaluate_thin(Interface s, vec3 wo, vec3 wi, float alpha)
{
    float cos_h;
    const vec2 ggx = ggx_reflection(wo, vec3(wi.xy, -wi.z), alpha, cos_h);
    const vec3 r = reflectance(s, cos_h);
    return LobeValue(s.weight * (1.0 - r) * s.tint * ggx.x, (1.0 - reflection_probability(s, r)) * ggx.y);
}

// Walter et al. 2007, eq. 16, 17 and 21, without the factor of radiance that they lack too.
LobeValue evaluate_refracted(Interface s, vec3 wo, vec3 wi, float alpha)
{
    precise const vec3 sum = wo + s.eta * wi;
    precise const vec3 h = normalize(sum.z > 0.0 ? sum : -sum);
    precise const float o_h = dot(wo, h);
    precise const float i_h = dot(wi, h);
    precise const float root = s.eta / (o_h + s.eta * i_h);
    precise const float stretch_o = ggx_stretch(wo, alpha);
    precise const float d = ggx_distribution(h, alpha) * o_h * -i_h * root * root;
    precise const float g = ggx_shadowing_over_cosine(wo.z, stretch_o, -wi.z, ggx_stretch(wi, alpha));
    const vec3 r = reflectance(s, clamp(o_h, 0.0, 1.0));
    const LobeValue v = LobeValue(s.weight * (1.0 - r) * s.tint * (d * g),
        (1.0 - reflection_probability(s, r)) * d * ggx_visibility(wo.z, stretch_o));
    if (o_h > 0.0 && i_h < 0.0)
        return v;
    return NO_LOBE_VALUE;
}

LobeValue evaluate(Interface s, vec3 wo, vec3 wi)
{
    const float alpha = max(s.alpha, GGX_ALPHA_MIN);
    LobeValue v = evaluate_refracted(s, wo, wi, alpha);
    if (s.thin)
        v = evaluate_thin(s, wo, wi, alpha);
    if (wi.z > 0.0)
        v = evaluate_reflected(s, wo, wi, alpha);
    if (s.alpha > 0.0)
        return v;
    return NO_LOBE_VALUE;
}
#endif

struct InterfaceSample {
    vec3 wi;
    vec3 weight;  // of a smooth interface, given that it was chosen
    bool transmitted;
};

// u: xy the facet, z reflection or transmission.
InterfaceSample sample_interface(Interface s, vec3 wo, vec3 u)
{
    // Smooth, in the frame of the surface.
    precise float cos_h = wo.z;
    precise vec3 up = mirrored(wo);
    precise vec3 down = vec3(-wo.xy / s.eta, -refracted_cosine(wo.z, s.eta));
#ifdef FX_ROUGH_DIELECTRIC
    const vec3 h = ggx_sample_visible_normal(wo, max(s.alpha, GGX_ALPHA_MIN), u.xy);
    if (s.alpha > 0.0) {
        cos_h = clamp(dot(wo, h), 0.0, 1.0);
        up = reflected(wo, h);
        down = refracted(wo, h, s.eta);
    }
#endif
    if (s.thin)
        down = vec3(up.xy, -up.z);
    const vec3 r = reflectance(s, cos_h);
    const float p = reflection_probability(s, r);
    InterfaceSample result;
    result.transmitted = !(u.z < p);
    result.wi = result.transmitted ? down : up;
    precise const vec3 weight = s.weight * (result.transmitted ? (1.0 - r) * s.tint / (1.0 - p) : r / p);
    result.weight = weight;
    return result;
}
#endif
