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

// Images, not samplers: a quarter faster on llvmpipe, which is where this pass is felt.
layout(rgba32f) readonly uniform image2D in_direct;
layout(rgba32f) readonly uniform image2D in_indirect;
layout(rgba32ui) readonly uniform uimage2D in_surface;
uniform writeonly image2D out_direct;
uniform writeonly image2D out_indirect;

uniform int step_size;          // distance between taps [px]
uniform float sigma_depth;      // eq. 3
uniform float sigma_normal;     // eq. 4
uniform float sigma_luminance;  // eq. 5

float kernel(int offset) { return offset == 0 ? 3.0 / 8.0 : abs(offset) == 1 ? 1.0 / 4.0 : 1.0 / 16.0; }

const float CENTER_WEIGHT = 9.0 / 64.0;

// 3x3 Gaussian of both variances (section 4.3); outside the frame and at misses the centre stands in.
vec2 blurred_variance(ivec2 px, vec2 center)
{
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        const ivec2 o = ivec2(i % 3, i / 3) - 1;
        const ivec2 q = px + o;
        const float weight = (o.x == 0 ? 0.5 : 0.25) * (o.y == 0 ? 0.5 : 0.25);
        const bool usable = inside_frame(q) && imageLoad(in_surface, q).x != 0u;
        sum += weight * (usable ? vec2(imageLoad(in_direct, q).a, imageLoad(in_indirect, q).a) : center);
    }
    return sum;
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec4 direct = imageLoad(in_direct, px);
    const vec4 indirect = imageLoad(in_indirect, px);
    const FilterSurface p = unpack_surface(imageLoad(in_surface, px));
    const vec2 luminance_p = vec2(luminance(direct.rgb), luminance(indirect.rgb));
    // The floor only matters where there is no variance: rounding of the luminance itself.
    const vec2 sharpness = 1.0
        / (sigma_luminance * sqrt(max(vec2(0.0), blurred_variance(px, vec2(direct.a, indirect.a))))
            + 1e-6 * luminance_p + 1e-37);

    vec4 sum_direct = vec4(direct.rgb, direct.a * CENTER_WEIGHT) * CENTER_WEIGHT;
    vec4 sum_indirect = vec4(indirect.rgb, indirect.a * CENTER_WEIGHT) * CENTER_WEIGHT;
    vec2 weight_sum = vec2(CENTER_WEIGHT);
    // Loops, not a branch: a miss has no taps. No division: llvmpipe divides integers one lane at a time.
    const int radius = p.depth > 0.0 ? 2 : -3;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const ivec2 o = ivec2(x, y);
            const ivec2 q = px + o * step_size;
            const FilterSurface other = unpack_surface(imageLoad(in_surface, q));
            const vec4 direct_q = imageLoad(in_direct, q);
            const vec4 indirect_q = imageLoad(in_indirect, q);
            const vec2 luminance_q = vec2(luminance(direct_q.rgb), luminance(indirect_q.rgb));
            const float geometry = depth_weight_exponent(p, other.depth, vec2(o * step_size), sigma_depth)
                + normal_weight_exponent(p.normal, other.normal, sigma_normal);
            const vec2 weight
                = kernel(x) * kernel(y) * exp(-geometry - abs(luminance_p - luminance_q) * sharpness);
            if (inside_frame(q) && other.depth > 0.0 && o != ivec2(0)) {
                sum_direct += vec4(direct_q.rgb, direct_q.a * weight.x) * weight.x;
                sum_indirect += vec4(indirect_q.rgb, indirect_q.a * weight.y) * weight.y;
                weight_sum += weight;
            }
        }
    const vec2 scale = 1.0 / weight_sum;
    const bool hit = p.depth > 0.0;
    imageStore(out_direct, px, hit ? sum_direct * vec2(scale.x, scale.x * scale.x).xxxy : direct);
    imageStore(out_indirect, px, hit ? sum_indirect * vec2(scale.y, scale.y * scale.y).xxxy : indirect);
}
