// A debug view's numbers as colours that can be told apart.
//
//   in   in_value     rgba32f
//   out  out_display  rgba8  sRGB
//
//   SHOW_RADIANCE  exposure and tone curve, as the picture    SHOW_NORMAL    -1..1 to 0..1
//   SHOW_COUNT     0..value_scale, dark blue to yellow        SHOW_ID        a colour of its own for each number
//   SHOW_MOTION    direction by hue, length by brightness     SHOW_DISTANCE  near bright, far dark
//   SHOW_FRACTION  position within cells of value_scale       SHOW_HEAT      0..value_scale, black, red, yellow, white
//   SHOW_MAGMA     0..value_scale, black, purple, pale yellow
#version 450
#include "lib/frame.glsl"
#include "lib/display.glsl"
#include "lib/random.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_value;
uniform writeonly image2D out_display;

uniform float value_scale;  // exposure, or what counts as large for this view

// Five points of the cividis map, readable with any colour vision.
// Source: Nunez, Anderton, Renslow 2018, "Optimizing colormaps with consideration for color vision deficiency".
const vec3 CIVIDIS[5] = vec3[](vec3(0.0, 0.135, 0.305), vec3(0.26, 0.305, 0.423), vec3(0.485, 0.483, 0.471),
    vec3(0.724, 0.674, 0.421), vec3(0.995, 0.909, 0.217));

// Five points of matplotlib's magma, as FLIP maps are usually drawn, and as the viewer's legend has them.
// Source: Smith, van der Walt 2015, matplotlib (CC0).
const vec3 MAGMA[5] = vec3[](vec3(0.0, 0.0, 0.016), vec3(0.318, 0.071, 0.486), vec3(0.718, 0.216, 0.475),
    vec3(0.988, 0.537, 0.380), vec3(0.988, 0.992, 0.749));

vec3 between(vec3 colors[5], float x)
{
    const float s = clamp(x, 0.0, 1.0) * 4.0;
    const int i = min(int(s), 3);
    return mix(colors[i], colors[i + 1], s - float(i));
}

vec3 heat(float x) { return clamp(vec3(3.0 * x, 3.0 * x - 1.0, 3.0 * x - 2.0), 0.0, 1.0); }

vec3 hue(float turns) { return clamp(abs(fract(turns + vec3(0.0, 2.0, 1.0) / 3.0) * 6.0 - 3.0) - 1.0, 0.0, 1.0); }

vec3 color_of(vec3 value)
{
#if defined(SHOW_RADIANCE)
    return srgb_encode(aces_curve(displayable(value * value_scale)));
#elif defined(SHOW_NORMAL)
    return value * 0.5 + 0.5;
#elif defined(SHOW_COUNT)
    return between(CIVIDIS, value.x / value_scale);
#elif defined(SHOW_HEAT)
    return heat(value.x / value_scale);
#elif defined(SHOW_MAGMA)
    return between(MAGMA, value.x / value_scale);
#elif defined(SHOW_ID)
    return vec3(pcg4d(uvec4(uint(value.x) + 1u, 7u, 11u, 13u)).xyz >> 24u) / 255.0 * 0.8 + 0.2;
#elif defined(SHOW_MOTION)
    const float size = length(value.xy);
    return size > 0.0 ? hue(atan(value.y, value.x) / (2.0 * PI)) * (1.0 - exp(-size / value_scale)) : vec3(0.0);
#elif defined(SHOW_DISTANCE)
    return vec3(value.x > 0.0 ? exp(-value.x / value_scale) : 0.0);
#elif defined(SHOW_FRACTION)
    return fract(value / value_scale);
#endif
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (inside_frame(px))
        imageStore(out_display, px, vec4(clamp(color_of(texelFetch(in_value, px, 0).rgb), 0.0, 1.0), 1.0));
}
