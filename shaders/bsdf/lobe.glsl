// What every lobe gives back, and GGX reflection, which three of them share.
#pragma once
#include "bsdf/albedo_table.glsl"
#include "bsdf/ggx.glsl"

struct LobeValue {
    vec3 value;  // f * |cos|
    float pdf;   // [1/sr], given that the lobe was chosen
};

const LobeValue NO_LOBE_VALUE = LobeValue(vec3(0.0), 0.0);

float average(vec3 rgb) { return (rgb.r + rgb.g + rgb.b) * (1.0 / 3.0); }

vec3 reflected(vec3 wo, vec3 h)
{
    precise const vec3 wi = 2.0 * dot(wo, h) * h - wo;
    return wi;
}

vec3 mirrored(vec3 wo) { return vec3(-wo.xy, wo.z); }

// A cosine of the viewer that is not below the resolution of unit vectors, so that nothing is divided by zero.
vec3 above_horizon(vec3 wo) { return vec3(wo.xy, max(wo.z, 5.9604645e-8)); }

// D G2 / (4 z_o) as value.x, density of visible normals over 4 cos as .y; `cos_h`: between wo and the half vector.
vec2 ggx_reflection(vec3 wo, vec3 wi, float alpha, out float cos_h)
{
    precise const vec3 h = normalize(wo + wi);
    precise const float stretch_o = ggx_stretch(wo, alpha);
    precise const float d = 0.25 * ggx_distribution(h, alpha);
    precise const vec2 result = d
        * vec2(ggx_shadowing_over_cosine(wo.z, stretch_o, wi.z, ggx_stretch(wi, alpha)),
            ggx_visibility(wo.z, stretch_o));
    cos_h = wi.z > 0.0 ? clamp(dot(wo, h), 0.0, 1.0) : 1.0;
    return wi.z > 0.0 ? result : vec2(0.0);
}
