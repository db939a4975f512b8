// FLIP, first pass: a picture as the screen shows it, in opponent colours.
//
//   in   in_radiance   rgba32f  scene-linear
//   out  out_opponent  rgba32f  brightness, red against green, blue against yellow (flip/color.glsl)
//
// What the screen shows is linear light again: encoding to sRGB and back is left out.
#version 450
#include "flip/color.glsl"
#include "lib/display.glsl"
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_radiance;
uniform writeonly image2D out_opponent;

uniform float exposure;     // as the tonemap pass has them
uniform int tonemap_curve;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec3 shown = tone_curve(texelFetch(in_radiance, px, 0).rgb * exposure, tonemap_curve);
    imageStore(out_opponent, px, vec4(opponent_of_rgb(shown), 0.0));
}
