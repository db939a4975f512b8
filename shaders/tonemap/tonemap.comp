// Exposure, tone curve and sRGB encoding.
//
//   in   in_radiance  rgba32f  scene-linear
//   out  out_display  rgba8    sRGB
#version 450
#include "lib/frame.glsl"
#include "lib/display.glsl"
#include "lib/counters.glsl"

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
    const vec3 radiance = texelFetch(in_radiance, px, 0).rgb;
    const vec3 exposed = radiance * exposure;
    note(STAGE_TONEMAP, kinds_in(radiance));
    note_cause(STAGE_TONEMAP, max_component(exposed) > MOST_DISPLAYABLE ? IS_CLAMPED : 0u);
    imageStore(out_display, px, vec4(srgb_encode(tone_curve(exposed, tonemap_curve)), 1.0));
    tell_noted(px, STAGE_TONEMAP);
}
