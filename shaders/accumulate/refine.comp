// A resting picture turns from the denoised one into the accumulated mean as samples come in.
//
//   in   in_denoised   rgba32f
//        in_mean       rgba32f
//   out  out_radiance  rgba32f
//
// If the denoiser is off by b and the mean of n samples has variance v / n, the best mix of the two gives the mean
// the weight b^2 / (b^2 + v / n) = n / (n + n*), where n* = v / b^2 is the count at which both are equally good.
#version 450
#include "lib/unknown.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_denoised;
uniform sampler2D in_mean;
uniform writeonly image2D out_radiance;

uniform float mean_weight;  // n / (n + n*), in [0, 1)

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 denoised = texelFetch(in_denoised, px, 0).rgb;
    const vec3 mean = texelFetch(in_mean, px, 0).rgb;
    const vec3 mix_of_both = denoised + mean_weight * (mean - denoised);
    const vec3 known = is_light(denoised) ? denoised : mean;
    const vec3 refined = is_light(denoised) && is_light(mean) ? mix_of_both : known;
    imageStore(out_radiance, px, vec4(counted_light(STAGE_ACCUMULATE, refined), 1.0));
    tell_noted(px, STAGE_ACCUMULATE);
}
