// Lambertian reflection in the shading frame (z along the normal), directions pointing away from the surface.
//
// eval() excludes the cosine; pdf is per solid angle [1/sr]. sample_cosine_hemisphere() samples it exactly, so
// the weight eval * cos / pdf of a sample is the albedo.
//
// Source: Pharr et al. 2023, "Physically Based Rendering", 4th ed., section 9.2.
#pragma once
#include "lib/sampling.glsl"

vec3 diffuse_eval(vec3 albedo, vec3 wo, vec3 wi) { return wo.z > 0.0 && wi.z > 0.0 ? albedo * INV_PI : vec3(0.0); }

float diffuse_pdf(float cos_wi) { return cos_wi > 0.0 ? cos_wi * INV_PI : 0.0; }
