// Where the frame met values that no healthy frame has, over the picture, which is dimmed.
//
//   in   painted_block  uint     kinds by bit, row by row (lib/counters.glsl)
//        in_display     rgba8    the picture
//   out  out_value      rgba32f  NUMBERS: the kinds' bits as a number, thrice
//        out_display    rgba8    else sRGB; of several kinds in a pixel the first
//
// A lone pixel is hard to find, so the ones around it are tinted.
#version 450
#include "lib/frame.glsl"
#include "lib/numbers.glsl"
#include "shared/bad_values.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer painted_block { uint kinds_of_pixels[]; };

uint kinds_at(ivec2 px) { return inside_frame(px) ? kinds_of_pixels[px.y * int(frame.extent.x) + px.x] : 0u; }

#ifdef NUMBERS

uniform writeonly image2D out_value;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (inside_frame(px))
        imageStore(out_value, px, vec4(vec3(float(kinds_at(px))), 1.0));
}

#else

uniform sampler2D in_display;
uniform writeonly image2D out_display;

const int HALO = 2;         // [px]
const float DIMMED = 0.25;  // of what the picture shows
const float TINTED = 0.7;   // of a kind's colour

const uint COLORS[KIND_COUNT] = uint[](NAN_COLOR, INFINITE_COLOR, NEGATIVE_COLOR, CLAMPED_COLOR);

vec3 color_of(uint kinds)
{
    const uint color = COLORS[findLSB(kinds)];
    return vec3(uvec3(color >> 16u, color >> 8u, color) & 255u) / 255.0;
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    uint around = 0u;
    for (int y = -HALO; y <= HALO; ++y)
        for (int x = -HALO; x <= HALO; ++x)
            around |= kinds_at(px + ivec2(x, y));
    vec3 color = vec3(DIMMED * luminance(texelFetch(in_display, px, 0).rgb));
    if (around != 0u)
        color = TINTED * color_of(around);
    if (kinds_at(px) != 0u)
        color = color_of(kinds_at(px));
    imageStore(out_display, px, vec4(color, 1.0));
}

#endif
