// The isotropic GGX microfacet distribution with height-correlated Smith shadowing, normals z > 0.
//
// All formulas use x^2 + y^2 instead of 1 - z^2, which has no digits left near the pole: the distribution then has a
// relative error of about 4 ulp / alpha of the half vector's components.
//
// Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding
// the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), eq. 99; Heitz 2018, "Sampling the GGX
// Distribution of Visible Normals", JCGT 7(4); Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical
// Caps" (the sampler).
#pragma once
#include "lib/numbers.glsl"

// Per solid angle of normals [1/sr]; integrates with the cosine to 1.
float ggx_distribution(vec3 h, float alpha)
{
    precise const vec2 slope = h.xy / alpha;
    precise const float k = dot(slope, slope) + h.z * h.z;
    precise const float d = INV_PI / (alpha * alpha * k * k);
    return d;
}

// sqrt(z^2 + alpha^2 (x^2 + y^2)) = z (1 + 2 Lambda).
float ggx_stretch(vec3 w, float alpha)
{
    precise const float s = sqrt(w.z * w.z + alpha * alpha * dot(w.xy, w.xy));
    return s;
}

// G2(wo, wi) / z_o, for z > 0 of both (or -z where light is transmitted).
float ggx_shadowing_over_cosine(float z_o, float stretch_o, float z_i, float stretch_i)
{
    precise const float g = 2.0 * z_i / (z_o * stretch_i + z_i * stretch_o);
    return g;
}

// Density of normals visible from wo, over D: G1(wo) / z_o; times D max(0, wo.h) it is per solid angle of normals.
float ggx_visibility(float z_o, float stretch_o) { return 2.0 / (z_o + stretch_o); }

// A normal with density ggx_visibility * D * wo.h; wo.z > 0.
vec3 ggx_sample_visible_normal(vec3 wo, float alpha, vec2 u)
{
    precise const vec3 w = normalize(vec3(alpha * wo.xy, wo.z));
    const float phi = 2.0 * PI * u.x;
    precise const float k = u.y * (1.0 + w.z);  // 1 - z on the cap, without cancellation
    precise const float sin_theta = sqrt(max(0.0, k * (2.0 - k)));
    precise const vec3 h
        = vec3(alpha * (sin_theta * vec2(cos(phi), sin(phi)) + w.xy), (1.0 + w.z) * (1.0 - u.y));
    return normalize(h);
}
