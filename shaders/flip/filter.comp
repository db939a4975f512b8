// FLIP's filters, separated: first along rows, then (DOWN) along columns.
//
//   in   in_opponent   rgba32f  flip/opponent.comp                                         rows
//   in   in_seen       rgba32f  what rows gave                                             DOWN
//        in_features   rgba32f  likewise
//   out  out_seen      rgba32f  rows: brightness, red-green, blue-yellow by its two Gaussians;
//                               DOWN: Hunt-adjusted CIELAB rgb, strength of edges a
//        out_features  rgba32f  brightness smoothed, its first and its second derivative     rows
//   out  out_points    r32f     strength of points                                         DOWN
//
// Source: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", sections 4.1.1 and 4.2.
// What is outside the picture repeats its border. Gaussians are taken step by step: exp(-(i + 1)^2 k) is
// exp(-i^2 k) exp(-(2 i + 1) k). Source: Turkowski 2007, "Incremental Computation of the Gaussian", GPU Gems 3.
#version 450
#include "flip/color.glsl"
#include "lib/frame.glsl"
#include "lib/numbers.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

const float PIXELS_PER_DEGREE = 3840.0 * PI / 180.0;  // 3840 pixels on 0.7 m, seen from 0.7 m

// Contrast sensitivity functions a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees (table 1): of brightness, of red
// against green, and the two whose sum is that of blue against yellow.
const vec4 SENSITIVITY_A = vec4(1.0, 1.0, 34.1, 13.5);
const vec4 SENSITIVITY_B = vec4(0.0047, 0.0053, 0.04, 0.025);
const vec4 SENSITIVITY_SIGMA = sqrt(SENSITIVITY_B / 2.0) / PI * PIXELS_PER_DEGREE;
const int SENSITIVITY_RADIUS = int(ceil(3.0 * SENSITIVITY_SIGMA.z));  // the widest to three deviations

const float FEATURE_WIDTH = 0.082;  // from peak to trough of an edge detector [degrees]
const float FEATURE_SIGMA = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
const int FEATURE_RADIUS = int(ceil(3.0 * FEATURE_SIGMA));

#ifdef DOWN
uniform sampler2D in_seen;
uniform sampler2D in_features;
uniform writeonly image2D out_points;
const ivec2 ALONG = ivec2(0, 1);
#else
uniform sampler2D in_opponent;
uniform writeonly image2D out_features;
const ivec2 ALONG = ivec2(1, 0);
#endif
uniform writeonly image2D out_seen;

ivec2 neighbour(ivec2 px, int i) { return clamp(px + i * ALONG, ivec2(0), ivec2(frame.extent) - 1); }

vec4 seen_at(ivec2 px)
{
#ifdef DOWN
    return texelFetch(in_seen, px, 0);
#else
    return texelFetch(in_opponent, px, 0).xyzz;
#endif
}

vec3 features_at(ivec2 px)
{
#ifdef DOWN
    return texelFetch(in_features, px, 0).xyz;
#else
    return texelFetch(in_opponent, px, 0).xxx;
#endif
}

// Each channel by its Gaussian; `weights` is what the taps sum up to.
vec4 seen(ivec2 px, out vec4 weights)
{
    const vec4 first = exp(-0.5 / (SENSITIVITY_SIGMA * SENSITIVITY_SIGMA));
    vec4 ratio = first;
    vec4 weight = vec4(1.0);
    vec4 sum = seen_at(px);
    weights = vec4(1.0);
    for (int i = 1; i <= SENSITIVITY_RADIUS; ++i) {
        weight *= ratio;
        ratio *= first * first;
        sum += weight * (seen_at(neighbour(px, -i)) + seen_at(neighbour(px, i)));
        weights += 2.0 * weight;
    }
    return sum / weights;
}

struct Features {
    vec3 smoothed;
    float first;   // of channel x: derivatives, their positive and negative weights summing to 1 and -1
    float second;
};

Features features(ivec2 px)
{
    const float decay = exp(-0.5 / (FEATURE_SIGMA * FEATURE_SIGMA));
    float ratio = decay;
    float weight = 1.0;
    const vec3 middle = features_at(px);
    Features f = Features(middle, 0.0, 0.0);
    float smooth_weights = 1.0;
    float first_weights = 0.0;
    vec2 second = vec2(0.0, -middle.x);  // positive and negative part
    vec2 second_weights = vec2(0.0, 1.0);
    for (int i = 1; i <= FEATURE_RADIUS; ++i) {
        weight *= ratio;
        ratio *= decay * decay;
        const vec3 before = features_at(neighbour(px, -i));
        const vec3 after = features_at(neighbour(px, i));
        f.smoothed += weight * (before + after);
        smooth_weights += 2.0 * weight;
        f.first += float(i) * weight * (before.x - after.x);
        first_weights += float(i) * weight;
        const float bend = weight * (float(i * i) / (FEATURE_SIGMA * FEATURE_SIGMA) - 1.0);
        const vec2 part = bend > 0.0 ? vec2(bend, 0.0) : vec2(0.0, bend);
        second += part * (before.x + after.x);
        second_weights += 2.0 * abs(part);
    }
    f.smoothed /= smooth_weights;
    f.first /= first_weights;
    f.second = second.x / second_weights.x + second.y / second_weights.y;
    return f;
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    vec4 weights;
    const vec4 s = seen(px, weights);
    const Features f = features(px);
#ifdef DOWN
    // A sum of Gaussians is normalised as a whole: each counts by the weights it had before.
    const vec2 share = (SENSITIVITY_A * sqrt(PI / SENSITIVITY_B) * weights * weights).zw;
    const vec3 opponent = vec3(s.xy, dot(share, s.zw) / (share.x + share.y));
    imageStore(out_seen, px,
        vec4(hunt_lab_of_rgb(rgb_of_opponent(opponent)), length(vec2(f.smoothed.y, f.first))));
    imageStore(out_points, px, vec4(length(vec2(f.smoothed.z, f.second))));
#else
    imageStore(out_seen, px, s);
    imageStore(out_features, px, vec4(f.smoothed.x, f.first, f.second, 0.0));
#endif
}
