// What the filter compares between two pixels of a surface: depth, its gradient, and the shading normal.
#pragma once
#include "lib/frame.glsl"
#include "lib/packing.glsl"
#include "lib/numbers.glsl"

#ifdef FX_LENS
uniform float lens_radius;     // [m], 0: pinhole
uniform float focus_distance;  // view depth [m]
#endif

struct FilterSurface {
    float depth;    // view depth [m]; a miss, which takes part in nothing: 0, and whatever else is no depth
    vec2 gradient;  // change of depth per pixel along x and y [m/px]
    vec3 normal;
};

bool is_depth(float depth) { return depth > 0.0 && depth <= 3e38; }

FilterSurface unpack_surface(uvec4 texel)
{
    return FilterSurface(uintBitsToFloat(texel.x), uintBitsToFloat(texel.yz), unpack_octahedral(texel.w));
}

// How far from its pixel's middle ray the lens may have found a surface of this depth [pixel footprints].
float circle_of_confusion(float depth)
{
#ifdef FX_LENS
    if (lens_radius > 0.0)
        return lens_radius * abs(depth - focus_distance) / (focus_distance * frame.camera.pixel_footprint * depth);
#endif
    return 0.0;
}

// Eq. 3 of Schied et al. 2017: exp(-|z_p - z_q| / (sigma_z |grad z . (p - q)|)).
// The paper's epsilon against division by zero becomes a tenth of the pixel's own footprint, so that the filter does
// the same at any scale of the scene. Out of focus both depths may belong anywhere in the circle of confusion.
float depth_weight_exponent(FilterSurface p, float depth_q, vec2 offset, float sigma_depth)
{
    const float floor_per_pixel = 0.1 * frame.camera.pixel_footprint * p.depth;
    float expected = sigma_depth * abs(dot(p.gradient, offset)) + floor_per_pixel * length(offset);
#ifdef FX_LENS
    if (lens_radius > 0.0)
        expected += sigma_depth * length(p.gradient) * circle_of_confusion(p.depth);
#endif
    return abs(p.depth - depth_q) / max(expected, 1e-37);  // 1e-37: only for offset 0
}

// Eq. 4, max(0, n_p . n_q) ^ sigma_n, as the exponent -x of exp(-x): the three edge-stopping functions multiply, so
// their exponents add up to a single exponential.
float normal_weight_exponent(vec3 normal_p, vec3 normal_q, float sigma_normal)
{
    const float cosine = clamp(dot(normal_p, normal_q), 1e-8, 1.0);
    return -sigma_normal * log(cosine);
}
