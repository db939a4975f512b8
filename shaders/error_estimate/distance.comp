// How far each pixel of the denoised picture is from the running mean, relative to the mean: what the view
// `measured_error` shows. The mean's own noise is in it, so it means something only once that is small.
//
//   in   in_picture    rgba32f  denoised picture
//        in_mean       rgba32f  running mean
//   out  out_distance  r32f     root of the pixel's part in relMSE [1]
#version 450
#include "error_estimate/relative.glsl"
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_picture;
uniform sampler2D in_mean;
uniform writeonly image2D out_distance;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 mean = texelFetch(in_mean, px, 0).rgb;
    imageStore(out_distance, px, vec4(sqrt(relative_square(texelFetch(in_picture, px, 0).rgb - mean, mean))));
}
