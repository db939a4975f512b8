// Running mean of the raw picture while nothing changes: the reference, and what a resting picture turns into.
//
//   in   in_radiance    rgba32f  this frame's undenoised picture
//        prev_mean      rgba32f  mean of the frames before rgb; a: its own expected relMSE
//        prev_variance  rgba32f  variance of a frame about the mean rgb [radiance^2]
//   out  out_mean       rgba32f  feeds back next frame as prev_mean
//        out_variance   rgba32f  likewise
//   WITH_REFERENCE: a denoised picture is measured against an older mean, of samples that it no longer holds.
//   in   prev_reference rgba32f  such a mean
//   out  out_reference  rgba32f  the same, or this frame's mean instead
//
// A mean, not a sum: a sum of 1e6 equal frames is 1 % off in 32 bits. Source: Welford 1962, "Note on a Method for
// Calculating Corrected Sums of Squares and Products".
#version 450
#include "error_estimate/relative.glsl"
#include "lib/unknown.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_radiance;
uniform sampler2D prev_mean;
uniform sampler2D prev_variance;
uniform writeonly image2D out_mean;
uniform writeonly image2D out_variance;
#ifdef WITH_REFERENCE
uniform sampler2D prev_reference;
uniform writeonly image2D out_reference;
uniform int takes_reference;  // 1: this frame's mean becomes the reference
#endif

// What differs from the mean by more than a square can hold has the largest square that there is.
const float MOST_SQUARE = 1e36;

uniform int frame_count;  // frames in the mean with this one, >= 1

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 radiance = texelFetch(in_radiance, px, 0).rgb;
    const bool known = counted_known(STAGE_ACCUMULATE, radiance);
    const float count = float(frame_count);
    vec3 mean = radiance;
    vec3 variance = vec3(0.0);
    float noise = 0.0;
    const vec3 old = texelFetch(prev_mean, px, 0).rgb;
    if (frame_count > 1 && is_light(old)) {
        const vec3 old_variance = texelFetch(prev_variance, px, 0).rgb;
        mean = old;
        variance = is_light(old_variance) ? old_variance : vec3(0.0);
        if (known) {  // else there is no sample, and the others stand
            mean = old + (radiance - old) / count;
            const vec3 square = (radiance - old) * (radiance - mean);
            note(STAGE_ACCUMULATE, max_component(square) > MOST_SQUARE ? IS_CLAMPED : 0u);
            variance += (min(square, vec3(MOST_SQUARE)) - variance) / count;
        }
        // Of n - 1 degrees of freedom, and of a mean of n.
        noise = relative_variance(variance / (count - 1.0), mean);
    }
    const uint kinds = kinds_in(mean, variance);
    note(STAGE_ACCUMULATE, kinds);
    if (kinds != 0u) {
        mean = unknown_light();
        variance = vec3(0.0);
        noise = 0.0;
    }
    imageStore(out_mean, px, vec4(mean, noise));
    imageStore(out_variance, px, vec4(variance, 0.0));
#ifdef WITH_REFERENCE
    imageStore(out_reference, px, takes_reference != 0 ? vec4(mean, noise) : texelFetch(prev_reference, px, 0));
#endif
    tell_noted(px, STAGE_ACCUMULATE);
}
