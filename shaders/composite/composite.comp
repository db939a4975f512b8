// Puts the picture together: albedo * (direct + indirect) + emission, the exact inverse of the demodulation.
//
//   in   in_direct, in_indirect  rgba32f  demodulated radiance
//        in_albedo, in_emission  rgba32f  G-buffer
//   out  out_radiance            rgba32f  scene-linear radiance
#version 450
#include "lib/frame.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_direct;
uniform sampler2D in_indirect;
uniform sampler2D in_albedo;
uniform sampler2D in_emission;
uniform writeonly image2D out_radiance;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 light = texelFetch(in_direct, px, 0).rgb + texelFetch(in_indirect, px, 0).rgb;
    const vec3 radiance = texelFetch(in_albedo, px, 0).rgb * light + texelFetch(in_emission, px, 0).rgb;
    imageStore(out_radiance, px, vec4(counted_finite(radiance), 1.0));
}
