// What part of the light an interface reflects. Cosines are of unit vectors on the same side, in [0, 1].
//
// Sources: Born and Wolf 1999, "Principles of Optics", section 1.5.2 (unpolarised light); Schlick 1994, "An
// Inexpensive BRDF Model for Physically-based Rendering", eq. 15; Pharr et al. 2023, "Physically Based Rendering",
// 4th ed., eq. 9.14 (thin slab).
#pragma once

// Cosine of the refracted direction; 0 from total internal reflection on. `eta`: index behind over index before.
float refracted_cosine(float cos_i, float eta)
{
    // eta^2 - 1 + cos^2 keeps its digits where the index hardly changes.
    precise const float cos_t = sqrt(max(0.0, (eta - 1.0) * (eta + 1.0) + cos_i * cos_i)) / eta;
    return cos_t;
}

// 1 where all light is reflected.
float fresnel_dielectric(float cos_i, float eta)
{
    precise const float cos_t = refracted_cosine(cos_i, eta);
    precise const float a = eta * cos_i, b = eta * cos_t;
    // Both denominators vanish only at the horizon, where all light is reflected.
    precise const float parallel = (a - cos_t) / (a + cos_t);
    precise const float perpendicular = (cos_i - b) / (cos_i + b);
    precise const float f = 0.5 * (parallel * parallel + perpendicular * perpendicular);
    return cos_t > 0.0 && cos_i > 0.0 ? min(f, 1.0) : 1.0;
}

// At normal incidence.
float fresnel_normal(float eta)
{
    precise const float r = (eta - 1.0) / (eta + 1.0);
    return r * r;
}

// How far on the way from F0 to F90.
float schlick_weight(float cos_i)
{
    precise const float x = clamp(1.0 - cos_i, 0.0, 1.0);
    return (x * x) * (x * x) * x;
}

// Of two parallel interfaces of reflectance `f` with all reflections between them.
vec3 slab_reflectance(vec3 f) { return 2.0 * f / (1.0 + f); }
