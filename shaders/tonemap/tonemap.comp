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
uniform int tonemap_curve;  // 0: ACES-like, 1: none

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 x = displayable(texelFetch(in_radiance, px, 0).rgb * exposure);
    const vec3 curved = tonemap_curve == 0 ? aces_curve(x) : min(x, vec3(1.0));
    imageStore(out_display, px, vec4(srgb_encode(curved), 1.0));
}
