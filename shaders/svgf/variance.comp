// SVGF variance where history is too short for temporal moments: estimated over 7x7 similar pixels.
//
//   in   in_direct, in_indirect    rgba32f   blended radiance, temporal variance a
//        in_moments                rgba32f   luminance mean and variance of direct (xy) and indirect (zw)
//        in_length                 r32f      history length [frames]
//        in_surface                rgba32ui  G-buffer
//   out  out_direct, out_indirect  rgba32f   the same radiance, better variance a
//
// Source: Schied et al. 2017, section 4.2: 7x7 bilateral weights from depth and normal, below four frames.
#version 450
#include "svgf/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_direct;
uniform sampler2D in_indirect;
uniform sampler2D in_moments;
uniform sampler2D in_length;
uniform usampler2D in_surface;
uniform writeonly image2D out_direct;
uniform writeonly image2D out_indirect;

uniform int svgf_spatial_frames;  // histories shorter than this are estimated spatially
uniform float sigma_depth;
uniform float sigma_normal;

const int RADIUS = 3;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec4 direct = texelFetch(in_direct, px, 0);
    const vec4 indirect = texelFetch(in_indirect, px, 0);
    const vec4 center = texelFetch(in_moments, px, 0);
    const FilterSurface p = unpack_surface(texelFetch(in_surface, px, 0));
    const bool spatial = p.depth > 0.0 && texelFetch(in_length, px, 0).x < float(svgf_spatial_frames);

    // Moments about the middle pixel's mean, so that the difference of two large numbers is never taken.
    vec4 sum = vec4(0.0);  // first and second moment of direct (xy), of indirect (zw)
    float weight_sum = 0.0;
    const int radius = spatial ? RADIUS : -RADIUS - 1;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) {
            const ivec2 q = px + ivec2(x, y);
            const FilterSurface other = unpack_surface(texelFetch(in_surface, q, 0));
            const vec4 moments = texelFetch(in_moments, q, 0);
            const float weight = exp(-depth_weight_exponent(p, other.depth, vec2(x, y), sigma_depth)
                - normal_weight_exponent(p.normal, other.normal, sigma_normal));
            if (inside_frame(q) && other.depth > 0.0) {
                const vec2 delta = moments.xz - center.xz;
                sum += weight * vec4(delta.x, moments.y + delta.x * delta.x, delta.y, moments.w + delta.y * delta.y);
                weight_sum += weight;
            }
        }
    vec2 variance = vec2(direct.a, indirect.a);
    if (spatial) {
        const vec4 m = sum / weight_sum;
        variance = max(vec2(0.0), m.yw - m.xz * m.xz);
    }
    imageStore(out_direct, px, vec4(direct.rgb, variance.x));
    imageStore(out_indirect, px, vec4(indirect.rgb, variance.y));
}
