// SVGF a-trous wavelet filter: one iteration over both signals, which share their geometry weights.
//
//   in   in_direct, in_indirect    rgba32f   demodulated radiance rgb, luminance variance a
//        in_surface                rgba32ui  G-buffer
//   out  out_direct, out_indirect  rgba32f   as the input, filtered
//
// Run N times with step_size = 1, 2, 4, ...; one of the outputs also feeds next frame's history.
//
// Source: Schied et al. 2017, eq. 1 to 5; 5x5 B3-spline kernel of Dammertz et al. 2010.
// Differs from the paper: a miss is copied and never a neighbour; no epsilon is absolute.
#version 450
#include "svgf/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_direct;
uniform sampler2D in_indirect;
uniform usampler2D in_surface;
uniform writeonly image2D out_direct;
uniform writeonly image2D out_indirect;

uniform int step_size;          // distance between taps [px]
uniform float sigma_depth;      // eq. 3
uniform float sigma_normal;     // eq. 4
uniform float sigma_luminance;  // eq. 5

const float KERNEL[3] = float[](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);

// 3x3 Gaussian of both variances (section 4.3); outside the frame and at misses the centre stands in.
vec2 blurred_variance(ivec2 px, vec2 center)
{
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        const ivec2 o = ivec2(i % 3, i / 3) - 1;
        const ivec2 q = px + o;
        const float weight = (o.x == 0 ? 0.5 : 0.25) * (o.y == 0 ? 0.5 : 0.25);
        const bool usable = inside_frame(q) && texelFetch(in_surface, q, 0).x != 0u;
        sum += weight * (usable ? vec2(texelFetch(in_direct, q, 0).a, texelFetch(in_indirect, q, 0).a) : center);
    }
    return sum;
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec4 direct = texelFetch(in_direct, px, 0);
    const vec4 indirect = texelFetch(in_indirect, px, 0);
    const FilterSurface p = unpack_surface(texelFetch(in_surface, px, 0));
    const vec2 luminance_p = vec2(luminance(direct.rgb), luminance(indirect.rgb));
    // The floor only matters where there is no variance: rounding of the luminance itself.
    const vec2 tolerance = sigma_luminance * sqrt(max(vec2(0.0), blurred_variance(px, vec2(direct.a, indirect.a))))
        + 1e-6 * luminance_p + 1e-37;

    vec4 sum_direct = vec4(direct.rgb, direct.a * KERNEL[0] * KERNEL[0]) * KERNEL[0] * KERNEL[0];
    vec4 sum_indirect = vec4(indirect.rgb, indirect.a * KERNEL[0] * KERNEL[0]) * KERNEL[0] * KERNEL[0];
    vec2 weight_sum = vec2(KERNEL[0] * KERNEL[0]);
    int tap = p.depth > 0.0 ? 0 : 25;
    while (tap < 25) {
        const ivec2 o = ivec2(tap % 5, tap / 5) - 2;
        const ivec2 q = px + o * step_size;
        const FilterSurface other = unpack_surface(texelFetch(in_surface, q, 0));
        const vec4 direct_q = texelFetch(in_direct, q, 0);
        const vec4 indirect_q = texelFetch(in_indirect, q, 0);
        const vec2 luminance_q = vec2(luminance(direct_q.rgb), luminance(indirect_q.rgb));
        const float geometry = KERNEL[abs(o.x)] * KERNEL[abs(o.y)] * normal_weight(p.normal, other.normal, sigma_normal);
        const float depth = depth_weight_exponent(p, other.depth, vec2(o * step_size), sigma_depth);
        const vec2 weight = geometry * exp(-depth - abs(luminance_p - luminance_q) / tolerance);
        if (inside_frame(q) && other.depth > 0.0 && o != ivec2(0)) {
            sum_direct += vec4(direct_q.rgb, direct_q.a * weight.x) * weight.x;
            sum_indirect += vec4(indirect_q.rgb, indirect_q.a * weight.y) * weight.y;
            weight_sum += weight;
        }
        ++tap;
    }
    const vec2 scale = 1.0 / weight_sum;
    const bool hit = p.depth > 0.0;
    imageStore(out_direct, px, hit ? sum_direct * vec2(scale.x, scale.x * scale.x).xxxy : direct);
    imageStore(out_indirect, px, hit ? sum_indirect * vec2(scale.y, scale.y * scale.y).xxxy : indirect);
}
