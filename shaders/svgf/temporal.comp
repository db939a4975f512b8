// SVGF temporal accumulation: reprojects last frame's light and blends it with this frame's samples.
//
//   in   in_direct, in_indirect        rgba32f   this frame's demodulated radiance
//        in_surface, in_identity       rgba32ui  G-buffer
//        in_position, in_motion        rgba32f   G-buffer
//        prev_direct, prev_indirect    rgba32f   filtered radiance rgb, unused a (last frame's feedback)
//        prev_moments                  rgba32f   luminance mean and variance of direct (xy) and indirect (zw)
//        prev_length                   r32f      history length [frames]
//        prev_surface, prev_identity   rgba32ui  last frame's G-buffer
//   out  out_direct, out_indirect      rgba32f   blended radiance rgb, luminance variance a
//        out_moments, out_length                 feed back next frame as prev_moments, prev_length
//
// Source: Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering", sections 4.1 and 4.2.
// Differs from the paper: consistency is a plane distance in pixel footprints, a normal and an id test for each tap;
// moments are kept centred (mean, variance), which is the same exponential average without cancellation; the history
// length is the least of the taps used.
#version 450
#include "svgf/surface.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_direct;
uniform sampler2D in_indirect;
uniform usampler2D in_surface;
uniform usampler2D in_identity;
uniform sampler2D in_position;
uniform sampler2D in_motion;
uniform sampler2D prev_direct;
uniform sampler2D prev_indirect;
uniform sampler2D prev_moments;
uniform sampler2D prev_length;
uniform usampler2D prev_surface;
uniform usampler2D prev_identity;

uniform writeonly image2D out_direct;
uniform writeonly image2D out_indirect;
uniform writeonly image2D out_moments;
uniform writeonly image2D out_length;

uniform int history_valid;
uniform int history_max;         // longest history [frames]
uniform float svgf_alpha;        // least weight of the new frame's radiance
uniform float svgf_moments_alpha;
uniform float reproject_depth;   // tolerated distance from the surface's plane [pixel footprints]
uniform float reproject_normal;  // least cosine between the normals

// Taps this light do not take part: they could only shorten histories.
const float LEAST_TAP_WEIGHT = 1e-3;

struct Current {
    vec3 position;
    vec3 geometric_normal;
    vec3 shading_normal;
    uvec2 ids;
    float tolerance;  // [m]
};

struct HistorySum {
    vec3 direct;
    vec3 indirect;
    vec4 moments;
    float least_length;
    float weight;
};

// Whether last frame's pixel q shows the same piece of surface. Written as accept-if: a NaN anywhere rejects.
bool consistent(Current c, ivec2 q)
{
    if (!inside_frame(q))
        return false;
    const uvec4 identity = texelFetch(prev_identity, q, 0);
    const uvec4 surface = texelFetch(prev_surface, q, 0);
    const vec3 position = frame.prev_camera.position
        + uintBitsToFloat(surface.x) * camera_direction(frame.prev_camera, vec2(q) + 0.5);
    const float plane_distance = abs(dot(c.geometric_normal, position - c.position));
    return identity.w != 0u && identity.xy == c.ids && plane_distance <= c.tolerance
        && dot(unpack_octahedral(surface.w), c.shading_normal) >= reproject_normal;
}

void add_tap(Current c, ivec2 q, float weight, inout HistorySum sum)
{
    if (weight >= LEAST_TAP_WEIGHT && consistent(c, q)) {
        sum.direct += weight * texelFetch(prev_direct, q, 0).rgb;
        sum.indirect += weight * texelFetch(prev_indirect, q, 0).rgb;
        sum.moments += weight * texelFetch(prev_moments, q, 0);
        sum.least_length = min(sum.least_length, texelFetch(prev_length, q, 0).x);
        sum.weight += weight;
    }
}

// 2x2 bilinear taps, each tested; where none holds and there is something to find, the 3x3 neighbourhood.
HistorySum reproject(Current c, vec2 prev_pixel, bool has_past)
{
    HistorySum sum = HistorySum(vec3(0.0), vec3(0.0), vec4(0.0), 1e9, 0.0);
    const vec2 corner = floor(prev_pixel - 0.5);
    const vec2 f = prev_pixel - 0.5 - corner;
    for (int i = 0; i < 4; ++i) {
        const ivec2 o = ivec2(i & 1, i >> 1);
        const vec2 w = mix(1.0 - f, f, vec2(o));
        add_tap(c, ivec2(corner) + o, w.x * w.y, sum);
    }
    const ivec2 nearest = ivec2(floor(prev_pixel));
    const int radius = has_past && !(sum.weight > 0.0) ? 1 : -2;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            add_tap(c, nearest + ivec2(x, y), 1.0, sum);
    return sum;
}

// One step of the exponential average of mean and variance.
vec2 blend_moments(vec2 old, float value, float alpha)
{
    const float delta = value - old.x;
    return vec2(old.x + alpha * delta, (1.0 - alpha) * (old.y + alpha * delta * delta));
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const uvec4 surface = texelFetch(in_surface, px, 0);
    const uvec4 identity = texelFetch(in_identity, px, 0);
    const vec4 motion = texelFetch(in_motion, px, 0);
    const float depth = uintBitsToFloat(surface.x);
    const Current c = Current(texelFetch(in_position, px, 0).xyz, unpack_octahedral(identity.z),
        unpack_octahedral(surface.w), identity.xy,
        reproject_depth * frame.prev_camera.pixel_footprint * (depth + motion.z));
    const bool has_past = history_valid != 0 && identity.w != 0u && motion.w > 0.0;
    const HistorySum sum = reproject(c, vec2(px) + 0.5 + motion.xy, has_past);
    const bool found = has_past && sum.weight > 0.0;

    vec3 direct = texelFetch(in_direct, px, 0).rgb;
    vec3 indirect = texelFetch(in_indirect, px, 0).rgb;
    vec4 moments = vec4(luminance(direct), 0.0, luminance(indirect), 0.0);
    float length = 1.0;
    if (found) {
        length = min(sum.least_length + 1.0, float(history_max));
        const float alpha = max(svgf_alpha, 1.0 / length);
        const float alpha_moments = max(svgf_moments_alpha, 1.0 / length);
        const vec4 old = sum.moments / sum.weight;
        moments = vec4(blend_moments(old.xy, moments.x, alpha_moments), blend_moments(old.zw, moments.z, alpha_moments));
        const vec3 old_direct = sum.direct / sum.weight;
        const vec3 old_indirect = sum.indirect / sum.weight;
        direct = old_direct + alpha * (direct - old_direct);
        indirect = old_indirect + alpha * (indirect - old_indirect);
    }

    moments = counted_finite(moments);
    imageStore(out_direct, px, vec4(counted_finite(direct), moments.y));
    imageStore(out_indirect, px, vec4(counted_finite(indirect), moments.w));
    imageStore(out_moments, px, moments);
    imageStore(out_length, px, vec4(identity.w != 0u ? length : 0.0));
}
