// SVGF a-trous wavelet filter: one iteration over one kind of signal (SIGNAL_*).
//
//   in   in_light, in_light_2    rgba32f  demodulated radiance rgb, noise a (svgf/noise.glsl)
//        and the G-buffer textures of svgf/signal.glsl
//   out  out_light, out_light_2  rgba32f  as the input, filtered
//
// Run N times with step_size = 1, 2, 4, ...; one of the outputs also feeds next frame's history.
//
// Source: Schied et al. 2017, eq. 1 to 5; 5x5 B3-spline kernel of Dammertz et al. 2010.
// Differs from the paper: a miss is copied and never a neighbour; no epsilon is absolute.
#version 450
// Reads images, not samplers: a quarter faster on llvmpipe, which is where this pass is felt.
#include "svgf/signal.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform int step_size;          // distance between taps [px]
uniform float sigma_luminance;  // eq. 5

float kernel(int offset) { return offset == 0 ? 3.0 / 8.0 : abs(offset) == 1 ? 1.0 / 4.0 : 1.0 / 16.0; }

const float CENTER_WEIGHT = 9.0 / 64.0;

// Weights are pure numbers of which the middle's is about a tenth: where all are less than this there is no light near.
const float LEAST_WEIGHT = 1e-12;

// 3x3 Gaussian of both variances (section 4.3); outside the frame, at misses and where no light is known the centre
// stands in.
vec2 blurred_variance(ivec2 px, vec2 center)
{
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        const ivec2 o = ivec2(i % 3, i / 3) - 1;
        const ivec2 q = px + o;
        const float weight = (o.x == 0 ? 0.5 : 0.25) * (o.y == 0 ? 0.5 : 0.25);
        const Light light = load_light(q);
        const bool usable = inside_frame(q) && takes_part(guide_at(q)) && light.known;
        sum += weight * (usable ? vec2(light.first.a, light.second.a) : center);
    }
    return sum;
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const uint stage = STAGE_ATROUS_1 + uint(findMSB(step_size));
    const Light light = load_own_light(stage, px);
    const Guide p = guide_at(px);
    const vec2 luminance_p = vec2(luminance(light.first.rgb), luminance(light.second.rgb));
    // The floor only matters where there is no variance: rounding of the luminance itself. From what is not known nothing
    // differs.
    const vec2 sharpness = light.known ? 1.0
            / (sigma_luminance * sqrt(max(vec2(0.0), blurred_variance(px, vec2(light.first.a, light.second.a))))
                + 1e-6 * luminance_p + 1e-37)
                                       : vec2(0.0);

    vec4 sum = vec4(light.first.rgb, light.first.a * CENTER_WEIGHT) * CENTER_WEIGHT;
    vec4 sum_2 = vec4(light.second.rgb, light.second.a * CENTER_WEIGHT) * CENTER_WEIGHT;
    vec2 half_sum = light.half_difference * CENTER_WEIGHT;
    vec2 weight_sum = vec2(light.known ? CENTER_WEIGHT : 0.0);
    // Loops, not a branch: what takes no part has no taps. No division: llvmpipe divides integers a lane at a time.
    const bool filtered = takes_part(p);
    const int radius = filtered ? 2 : -3;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const ivec2 o = ivec2(x, y);
            const ivec2 q = px + o * step_size;
            const Guide other = guide_at(q);
            const Light light_q = load_light(q);
            const vec2 luminance_q = vec2(luminance(light_q.first.rgb), luminance(light_q.second.rgb));
            const float geometry = edge_exponent(p, other, vec2(o * step_size));
            const vec2 weight
                = kernel(x) * kernel(y) * exp(-geometry - abs(luminance_p - luminance_q) * sharpness);
            // Accept-if: a NaN in what is compared rejects.
            const bool comparable = geometry >= 0.0 && light_q.known;
            if (inside_frame(q) && takes_part(other) && comparable && o != ivec2(0)) {
                sum += vec4(light_q.first.rgb, light_q.first.a * weight.x) * weight.x;
                sum_2 += vec4(light_q.second.rgb, light_q.second.a * weight.y) * weight.y;
                half_sum += light_q.half_difference * weight;
                weight_sum += weight;
            }
        }
    const vec2 scale = 1.0 / weight_sum;
    const Light mean = Light(sum * vec2(scale.x, scale.x * scale.x).xxxy,
        sum_2 * vec2(scale.y, scale.y * scale.y).xxxy, half_sum * scale, min(weight_sum.x, weight_sum.y) >= LEAST_WEIGHT);
    store_light(stage, px, Light(filtered ? mean.first : light.first, filtered ? mean.second : light.second,
                        filtered ? mean.half_difference : light.half_difference, filtered ? mean.known : light.known));
    tell_noted(px, stage);
}
