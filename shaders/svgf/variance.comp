// SVGF variance where history is too short for temporal moments: estimated over 7x7 similar pixels.
//
//   in   in_light, in_light_2    rgba32f  blended radiance, noise a (svgf/noise.glsl) with the temporal variance
//        in_moments              rgba32f  luminance mean and variance of both signals (a single one: of it, zero)
//        in_length               r32f     history length [frames]
//        and the G-buffer textures of svgf/signal.glsl
//   out  out_light, out_light_2  rgba32f  the same radiance, better variance a
//
// Source: Schied et al. 2017, section 4.2: 7x7 bilateral weights from depth and normal, below four frames.
#version 450
#include "svgf/signal.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_moments;
uniform sampler2D in_length;

uniform int svgf_spatial_frames;  // histories shorter than this are estimated spatially

const int RADIUS = 3;
// What differs by more has the largest square that there is.
const float MOST_DELTA = 1e18;
// Of the second moment, what 49 rounded products may take away from it: 49 * 2^-24.
const float ROUNDING = 3e-6;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const Light light = load_own_light(STAGE_VARIANCE, px);
    const vec4 own = texelFetch(in_moments, px, 0);
    note(STAGE_VARIANCE, kinds_in(own.xyz, own.www));
    const vec4 center = is_light(own) ? own : vec4(0.0);
    const Guide p = guide_at(px);
    const bool spatial = takes_part(p) && texelFetch(in_length, px, 0).x < float(svgf_spatial_frames);

    // Moments about the middle pixel's mean, so that the difference of two large numbers is never taken.
    vec4 sum = vec4(0.0);  // first and second moment of one signal (xy), of the other (zw)
    float weight_sum = 0.0;
    float farthest = 0.0;
    const int radius = spatial ? RADIUS : -RADIUS - 1;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const ivec2 q = px + ivec2(x, y);
            const Guide other = guide_at(q);
            const vec4 moments = texelFetch(in_moments, q, 0);
            const float geometry = edge_exponent(p, other, vec2(x, y));
            const float weight = exp(-geometry);
            if (inside_frame(q) && takes_part(other) && geometry >= 0.0 && is_light(moments)) {
                const vec2 off = moments.xz - center.xz;
                const vec2 delta = clamp(off, -MOST_DELTA, MOST_DELTA);
                farthest = max(farthest, max(abs(off.x), abs(off.y)));
                sum += weight * vec4(delta.x, moments.y + delta.x * delta.x, delta.y, moments.w + delta.y * delta.y);
                weight_sum += weight;
            }
        }
    vec2 variance = vec2(light.first.a, light.second.a);
    if (spatial && weight_sum > 0.0) {
        const vec4 m = sum / weight_sum;
        const vec2 spread = m.yw - m.xz * m.xz;
        const uint kinds = kinds_in(vec3(spread + ROUNDING * m.yw, 0.0));
        note(STAGE_VARIANCE, kinds);
        note(STAGE_VARIANCE, farthest > MOST_DELTA ? IS_CLAMPED : 0u);
        variance = kinds == 0u ? max(vec2(0.0), spread) : vec2(0.0);
    }
    store_light(STAGE_VARIANCE, px, Light(vec4(light.first.rgb, variance.x), vec4(light.second.rgb, variance.y),
                        light.half_difference, light.known));
    tell_noted(px, STAGE_VARIANCE);
}
