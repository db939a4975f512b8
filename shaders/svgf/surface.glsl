// What the filter compares between two pixels: depth, its gradient, and the shading normal.
#pragma once
#include "lib/frame.glsl"
#include "lib/packing.glsl"
#include "lib/numbers.glsl"

struct FilterSurface {
    float depth;    // view depth [m], 0: a miss, which takes part in nothing
    vec2 gradient;  // change of depth per pixel along x and y [m/px]
    vec3 normal;
};

FilterSurface unpack_surface(uvec4 texel)
{
    return FilterSurface(uintBitsToFloat(texel.x), uintBitsToFloat(texel.yz), unpack_octahedral(texel.w));
}

// Eq. 3 of Schied et al. 2017: exp(-|z_p - z_q| / (sigma_z |grad z . (p - q)|)).
// The paper's epsilon against division by zero becomes a tenth of the pixel's own footprint, so that the filter does
// the same at any scale of the scene.
float depth_weight_exponent(FilterSurface p, float depth_q, vec2 offset, float sigma_depth)
{
    const float floor_per_pixel = 0.1 * frame.camera.pixel_footprint * p.depth;
    const float expected = sigma_depth * abs(dot(p.gradient, offset)) + floor_per_pixel * length(offset);
    return abs(p.depth - depth_q) / max(expected, 1e-37);  // 1e-37: only for offset 0
}

// Eq. 4, max(0, n_p . n_q) ^ sigma_n, as the exponent -x of exp(-x): the three edge-stopping functions multiply, so
// their exponents add up to a single exponential.
float normal_weight_exponent(vec3 normal_p, vec3 normal_q, float sigma_normal)
{
    const float cosine = clamp(dot(normal_p, normal_q), 1e-8, 1.0);
    return -sigma_normal * log(cosine);
}
