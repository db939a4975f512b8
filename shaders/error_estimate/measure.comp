// What the running mean's own noise comes to, and WITH_REFERENCE the denoised picture against an older mean, of samples
// that it does not hold: squares of what tells them apart, less what the mean's noise adds to them, are the picture's
// square error in the mean. They are relative to that mean: with few samples in it, pixels that happen to be dark weigh
// more.
//
//   in   in_mean       rgba32f  a: expected relMSE of the mean (accumulate/accumulate.comp)
//        in_picture    rgba32f  denoised picture
//        in_reference  rgba32f  the older mean rgb, and a: its own expected relMSE
//        in_albedo     rgba32f  and in_fog_way: what error_estimate/counts.glsl looks at
//   out  tile_block: sums over the pixels that count of the picture's relative square errors (x), of the reference's (y),
//        of the mean's (z), and how many pixels these are (w)
#version 450
#include "error_estimate/counts.glsl"
#include "error_estimate/tiles.glsl"

uniform sampler2D in_mean;
#ifdef WITH_REFERENCE
uniform sampler2D in_picture;
uniform sampler2D in_reference;
#endif

vec4 sums_at(ivec2 px)
{
    if (!counts(px))
        return vec4(0.0);
    const float noise = texelFetch(in_mean, px, 0).a;
#ifdef WITH_REFERENCE
    const vec4 reference = texelFetch(in_reference, px, 0);
    const vec3 error = texelFetch(in_picture, px, 0).rgb - reference.rgb;
    return vec4(relative_square(error, reference.rgb) - reference.a, reference.a, noise, 1.0);
#else
    return vec4(0.0, 0.0, noise, 1.0);
#endif
}
