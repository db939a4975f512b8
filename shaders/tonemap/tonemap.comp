// Exposure, tone curve and sRGB encoding.
//
//   in   in_radiance  rgba32f  scene-linear
//   out  out_display  rgba8    sRGB
#version 450
#include "lib/frame.glsl"
#include "lib/display.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_radiance;
uniform writeonly image2D out_display;

uniform float exposure;     // linear scale, >= 0
uniform int tonemap_curve;  // lib/display.glsl

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 shown = tone_curve(texelFetch(in_radiance, px, 0).rgb * exposure, tonemap_curve);
    imageStore(out_display, px, vec4(srgb_encode(shown), 1.0));
}
