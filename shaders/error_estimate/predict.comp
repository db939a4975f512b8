// The error of the filtered picture from the frame's own samples, without a reference: its noise, and all of it.
//
// Noise is what halves of the samples differ by (svgf/noise.glsl). The whole error follows from samples that a half picture
// does not hold: x_1 - B_1 and x_2 - B_2 of one pixel of colour A in two frames are independent but for what B is off, so
// their product is its square in the mean. Frames go in pairs for that, whose chessboards are alike: the first tells the
// noise and leaves its differences, the second the products.
//
//   in   in_direct, in_indirect, in_specular, in_scattered              rgba32f  filtered light, noise a
//        noisy_direct, noisy_indirect, noisy_specular, noisy_scattered  rgba32f  this frame's
//        in_picture                                                     rgba32f  the filtered picture
//        prev_difference                                                rgba32f  x_1 - B_1, in the second of a pair
//        in_motion, and the G-buffer textures of composite/compose.glsl
//   out  out_difference                                                 rgba32f  x_1 - B_1, relative to the picture; a: 1 if the pixel counts
//        tile_block: in the first of a pair sums of relative square errors over the pixels that count, of the filtered
//        picture's noise (x) and of this frame's samples (y), and how many pixels these are (w); in the second the
//        products (z), and how many (w)
#version 450
#include "error_estimate/noise_of_picture.glsl"
#include "error_estimate/counts.glsl"
#include "error_estimate/tiles.glsl"
#ifdef FX_FOG
#include "svgf/fog_motion.glsl"
#endif

uniform sampler2D in_picture;
uniform sampler2D noisy_direct;
uniform sampler2D noisy_indirect;
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D noisy_specular;
#endif
#ifdef FX_FOG
uniform sampler2D noisy_scattered;
#endif

uniform sampler2D prev_difference;
uniform sampler2D in_motion;
uniform writeonly image2D out_difference;
uniform int second_of_pair;

// Relative to the picture: what noise has moved it by, what tells this frame's samples from it, and from the half of the
// other colour.
struct Differences {
    vec3 noise;
    vec3 raw;
    vec3 half_picture;
};

Differences differences_at(ivec2 px)
{
    Signals noise;
    const Signals light = filtered_light(px, noise);
    // The picture is linear in its signals: what tells two pictures apart is made of what tells the signals apart.
    Signals raw = Signals(
        texelFetch(noisy_direct, px, 0).rgb + texelFetch(noisy_indirect, px, 0).rgb - light.diffuse, vec3(0.0), vec3(0.0));
#ifdef FX_SPECULAR_SIGNAL
    raw.specular = texelFetch(noisy_specular, px, 0).rgb - light.specular;
#endif
#ifdef FX_FOG
    raw.scattered = texelFetch(noisy_scattered, px, 0).rgb - light.scattered;
#endif
    const vec3 scale = relative_scale(texelFetch(in_picture, px, 0).rgb);
    Differences d;
    d.noise = scale * compose(px, vec3(0.0), noise);
    d.raw = scale * compose(px, vec3(0.0), raw);
    d.half_picture = d.raw + half_sign(px) * d.noise;
    return d;
}

vec4 first_of_pair(ivec2 px)
{
    const Differences d = differences_at(px);
    // Whether nothing is 0 or -0 would depend on which effects are compiled in.
    imageStore(out_difference, px, vec4(mix(d.half_picture, vec3(0.0), equal(d.half_picture, vec3(0.0))), 1.0));
    return vec4(dot(d.noise, d.noise) / 3.0, dot(d.raw, d.raw) / 3.0, 0.0, 1.0);
}

// Where the pixel was: xy: previous minus current pixel [px]; w: 1 if it is known.
vec4 motion_of_light(ivec2 px)
{
    const vec4 motion = texelFetch(in_motion, px, 0);
#ifdef FX_FOG
    if (counts(px) && texelFetch(in_albedo, px, 0).a == 0.0)  // nothing but fog
        return fog_motion(px, texelFetch(in_fog_way, px, 0).x, fog_sigma_t);
#endif
    return motion;
}

vec4 in_second_of_pair(ivec2 px)
{
    const vec4 motion = motion_of_light(px);
    const ivec2 before = ivec2(floor(vec2(px) + 0.5 + motion.xy));
    // Of the other colour, the older sample would be in this one's half picture.
    if (!(motion.w > 0.0) || !inside_prev_frame(before) || half_sign(before) != half_sign(px))
        return vec4(0.0);
    const vec4 earlier = texelFetch(prev_difference, before, 0);
    if (earlier.a == 0.0)
        return vec4(0.0);
    return vec4(0.0, 0.0, dot(differences_at(px).half_picture, earlier.rgb) / 3.0, 1.0);
}

vec4 sums_at(ivec2 px)
{
    if (second_of_pair != 0)
        return in_second_of_pair(px);
    if (counts(px))
        return first_of_pair(px);
    imageStore(out_difference, px, vec4(0.0));
    return vec4(0.0);
}
