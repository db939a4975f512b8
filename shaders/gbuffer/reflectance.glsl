// What the specular signal is divided by before the filter and multiplied with after it: how much the specular lobes
// reflect and transmit, roughly, so that textures of metals stay out of the filter. It need not be exact, only smooth
// and never zero.
//
// Source: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", for the angle.
#pragma once
#include "bsdf/fresnel.glsl"
#include "materials/shaded_material.glsl"
#include "lib/numbers.glsl"

// Below this division would make more noise than the texture it takes out.
const float LEAST_REFLECTANCE = 0.02;

// rgb; GGX alpha, negative where nothing is specular. `wo` as in material_at().
vec4 reflectance(ShadedMaterial m, vec3 wo)
{
    const float cosine = dot(m.shading_normal, wo);
    vec3 base = vec3(0.0);
    float alpha = 1.0;
    float coat = 0.0;
    float coat_alpha = 1.0;
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC) || defined(FX_ROUGH_DIELECTRIC)
    const float root = (m.ior - 1.0) / (m.ior + 1.0);
    const vec3 f0 = min(root * root * m.specular_color, vec3(1.0));
    const float rise = schlick_weight(cosine);
    base = mix(m.specular * (f0 + (1.0 - f0) * rise), m.albedo + (1.0 - m.albedo) * rise, m.metallic);
    alpha = m.alpha;
#endif
#if defined(FX_DIELECTRIC) || defined(FX_ROUGH_DIELECTRIC)
    base += (1.0 - m.metallic) * m.transmission * m.albedo;
#endif
#ifdef FX_CLEARCOAT
    coat = m.clearcoat * (0.04 + 0.96 * schlick_weight(cosine));
    coat_alpha = m.clearcoat_alpha;
#endif
    const float part_of_coat = coat / max(coat + max_component(base), LEAST_REFLECTANCE);
    const bool specular = max_component(base) + coat > 0.0;
    return specular ? vec4(max(base + coat, vec3(LEAST_REFLECTANCE)), mix(alpha, coat_alpha, part_of_coat))
                    : vec4(0.0, 0.0, 0.0, -1.0);
}
