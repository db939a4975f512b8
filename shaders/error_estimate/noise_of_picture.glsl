// How far noise has moved a pixel of the filtered picture, from the half differences of its signals (svgf/noise.glsl).
#pragma once
#include "composite/compose.glsl"
#include "svgf/noise.glsl"

uniform sampler2D in_direct;
uniform sampler2D in_indirect;
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D in_specular;
#endif
#ifdef FX_FOG
uniform sampler2D in_scattered;
#endif

// A half difference is luminance; noise has the colour of the light that it is noise of.
vec3 colored_half_difference(vec4 light)
{
    const float value = luminance(light.rgb);
    return half_difference_in(light.a) * (value > 0.0 ? light.rgb / value : vec3(1.0));
}

Signals filtered_light(ivec2 px, out Signals noise)
{
    const vec4 direct = texelFetch(in_direct, px, 0);
    const vec4 indirect = texelFetch(in_indirect, px, 0);
    Signals light = Signals(direct.rgb + indirect.rgb, vec3(0.0), vec3(0.0));
    noise = Signals(colored_half_difference(direct) + colored_half_difference(indirect), vec3(0.0), vec3(0.0));
#ifdef FX_SPECULAR_SIGNAL
    const vec4 specular = texelFetch(in_specular, px, 0);
    light.specular = specular.rgb;
    noise.specular = colored_half_difference(specular);
#endif
#ifdef FX_FOG
    const vec4 scattered = texelFetch(in_scattered, px, 0);
    light.scattered = scattered.rgb;
    noise.scattered = colored_half_difference(scattered);
#endif
    return light;
}
