// Running mean of the raw picture while nothing changes: the reference, and what a resting picture turns into.
//
//   in   in_radiance  rgba32f  this frame's undenoised picture
//        prev_mean    rgba32f  mean of the frames before
//   out  out_mean     rgba32f  feeds back next frame as prev_mean
//
// A mean, not a sum: a sum of 1e6 equal frames is 1 % off in 32 bits.
#version 450
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_radiance;
uniform sampler2D prev_mean;
uniform writeonly image2D out_mean;

uniform int frame_count;  // frames in the mean with this one, >= 1

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    vec3 mean = texelFetch(in_radiance, px, 0).rgb;
    if (frame_count > 1) {
        const vec3 old = texelFetch(prev_mean, px, 0).rgb;
        mean = old + (mean - old) / float(frame_count);
    }
    imageStore(out_mean, px, vec4(mean, 1.0));
}
