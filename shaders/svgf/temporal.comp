// SVGF temporal accumulation of one kind of signal (SIGNAL_*): reprojects last frame's light and blends it with this
// frame's samples.
//
//   in   in_light, in_light_2      rgba32f  this frame's demodulated radiance
//        prev_light, prev_light_2  rgba32f  filtered radiance rgb, noise a (last frame's feedback)
//        prev_moments              rgba32f  luminance mean and variance of the first (xy) and second (zw) signal
//        prev_length               r32f     history length [frames], 0 where there was no light of the kind
//        and the G-buffer textures, this frame's and last frame's, of svgf/past.glsl
//   out  out_light, out_light_2    rgba32f  blended radiance rgb, noise a (svgf/noise.glsl)
//        out_moments, out_length            feed back next frame as prev_moments, prev_length
//
// Source: Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering", sections 4.1 and 4.2.
// Differs from the paper: consistency is a plane distance in pixel footprints, a normal and an id test for each tap;
// moments are kept centred (mean, variance), which is the same exponential average without cancellation; the history
// length is the least of the taps used.
#version 450
#include "svgf/noise.glsl"
#include "svgf/past.glsl"
#include "lib/unknown.glsl"

#ifdef SIGNAL_DIFFUSE
#define SIGNAL_PAIR
#endif

layout(local_size_x = 8, local_size_y = 8) in;

#ifndef SIGNAL_SPECULAR  // past.glsl looks at its neighbours
uniform sampler2D in_light;
#endif
uniform sampler2D prev_light;
uniform writeonly image2D out_light;
#ifdef SIGNAL_PAIR
uniform sampler2D in_light_2;
uniform sampler2D prev_light_2;
uniform writeonly image2D out_light_2;
#endif
uniform sampler2D prev_moments;
uniform sampler2D prev_length;
uniform writeonly image2D out_moments;
uniform writeonly image2D out_length;

uniform int history_valid;
uniform int history_max;   // longest history [frames]
uniform float svgf_alpha;  // least weight of the new frame's radiance
uniform float svgf_moments_alpha;

// Taps this light do not take part: they could only shorten histories.
const float LEAST_TAP_WEIGHT = 1e-3;

struct HistorySum {
    vec3 first;
    vec3 second;
    vec2 half_difference;
    vec4 moments;
    float least_length;
    float weight;
};

void add_tap(Past p, ivec2 q, float weight, inout HistorySum sum)
{
    const float tap_length = texelFetch(prev_length, q, 0).x;
    if (!(weight >= LEAST_TAP_WEIGHT && tap_length >= 1.0 && consistent(p, q)))
        return;
    const vec4 first = texelFetch(prev_light, q, 0);
    const vec4 moments = texelFetch(prev_moments, q, 0);
#ifdef SIGNAL_PAIR
    const vec4 second = texelFetch(prev_light_2, q, 0);
#else
    const vec4 second = vec4(0.0);
#endif
    const bool known = is_light(first) && is_light(second) && is_light(moments);
    if (known) {
        sum.first += weight * first.rgb;
        sum.second += weight * second.rgb;
        sum.half_difference += weight * vec2(half_difference_in(first.a), half_difference_in(second.a));
        sum.moments += weight * moments;
        sum.least_length = min(sum.least_length, tap_length);
        sum.weight += weight;
    }
}

// 2x2 bilinear taps, each tested; where none holds and there is something to find, the 3x3 neighbourhood.
HistorySum reproject(Past p)
{
    HistorySum sum = HistorySum(vec3(0.0), vec3(0.0), vec2(0.0), vec4(0.0), 1e9, 0.0);
    const vec2 corner = floor(p.pixel - 0.5);
    const vec2 f = p.pixel - 0.5 - corner;
    for (int i = 0; i < 4; ++i) {
        const ivec2 o = ivec2(i & 1, i >> 1);
        const vec2 w = mix(1.0 - f, f, vec2(o));
        add_tap(p, ivec2(corner) + o, w.x * w.y, sum);
    }
    const ivec2 nearest = ivec2(floor(p.pixel));
    const int radius = p.exists && !(sum.weight > 0.0) ? 1 : -2;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            add_tap(p, nearest + ivec2(x, y), 1.0, sum);
    return sum;
}

// The mean of the taps; weight 0: history brings nothing.
HistorySum found_in_history(Past p)
{
    HistorySum old = reproject(p);
    const float weight = p.exists && old.weight > 0.0 ? old.weight : 1.0;
    old.first /= weight;
    old.second /= weight;
    old.half_difference /= weight;
    old.moments /= weight;
    const uint kinds = kinds_in(old.first, old.second) | kinds_in(old.moments.xyz, old.moments.www)
        | nonfinite_in(old.half_difference.x + old.half_difference.y);
    note(STAGE_HISTORY, kinds);
    old.weight = p.exists && kinds == 0u ? old.weight : 0.0;
    return old;
}

// One step of the exponential average of mean and variance. What differs by more than a square can hold has the largest
// variance that there is.
vec2 blend_moments(vec2 old, float value, float alpha)
{
    const float delta = value - old.x;
    const float bounded = clamp(delta, -1e18, 1e18);
    note(STAGE_MOMENTS, abs(delta) > 1e18 ? IS_CLAMPED : 0u);
    return vec2(old.x + alpha * delta, (1.0 - alpha) * (old.y + alpha * bounded * bounded));
}

// Four times the least normal number: below, a fraction of what is left rounds to nothing, and it would stay for ever.
const float LEAST_LIGHT = 4.7e-38;

// One step of the exponential average of light, which ends at zero.
vec3 blend_light(vec3 old, vec3 value, float alpha)
{
    const vec3 light = old + alpha * (value - old);
    return mix(light, vec3(0.0), lessThan(light, vec3(LEAST_LIGHT)));
}

// A mirror's light is filtered over time alone, so more of it is kept.
float least_alpha(Past p)
{
#ifdef SIGNAL_SPECULAR
    return svgf_alpha * mix(0.25, 1.0, smoothstep(0.0, 0.05, p.key));
#else
    return svgf_alpha;
#endif
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    Past p = past_of(px);
    p.exists = p.exists && lit(px) && history_valid != 0;
    const HistorySum old = found_in_history(p);
    const bool found = old.weight > 0.0;

    vec3 first = texelFetch(in_light, px, 0).rgb;
#ifdef SIGNAL_PAIR
    vec3 second = texelFetch(in_light_2, px, 0).rgb;
#else
    vec3 second = vec3(0.0);
#endif
    note(STAGE_TEMPORAL, kinds_in(first, second));
    const bool known = is_light(first) && is_light(second);
    vec4 moments = vec4(luminance(first), 0.0, luminance(second), 0.0);
    float length = known ? 1.0 : 0.0;
    // What is already known of the mean does not belong to the noise: it would pass where halves weigh unequally.
    vec2 half_difference = half_sign(px) * moments.xz;
    if (found) {
        half_difference = old.half_difference;
        length = min(old.least_length + length, float(history_max));
        if (known) {
            const float alpha = max(least_alpha(p), 1.0 / length);
            const float alpha_moments = max(svgf_moments_alpha, 1.0 / length);
            moments = vec4(blend_moments(old.moments.xy, moments.x, alpha_moments),
                blend_moments(old.moments.zw, moments.z, alpha_moments));
            const vec2 surprise = vec2(luminance(first - old.first), luminance(second - old.second));
            half_difference = mix(half_difference, half_sign(px) * surprise, alpha);
            first = blend_light(old.first, first, alpha);
            second = blend_light(old.second, second, alpha);
        } else {
            moments = old.moments;
            first = old.first;
            second = old.second;
        }
    } else if (!known) {
        first = second = unknown_light();
        moments = unknown_light().xxxx;
    }

    const uint light_kinds = kinds_in(first, second);
    const uint moment_kinds = kinds_in(moments.xyz, moments.www) | nonfinite_in(half_difference.x + half_difference.y);
    note(STAGE_TEMPORAL, light_kinds);
    note(STAGE_MOMENTS, moment_kinds);
    if ((light_kinds | moment_kinds) != 0u) {
        first = unknown_light();
        second = unknown_light();
        moments = unknown_light().xxxx;
        half_difference = vec2(0.0);
        length = 0.0;
    }
    imageStore(out_light, px, vec4(first, pack_noise(moments.y, half_difference.x)));
#ifdef SIGNAL_PAIR
    imageStore(out_light_2, px, vec4(second, pack_noise(moments.w, half_difference.y)));
#endif
    imageStore(out_moments, px, moments);
    imageStore(out_length, px, vec4(lit(px) ? length : 0.0));
    tell_noted(px, STAGE_HISTORY);
}
