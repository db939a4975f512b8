// Two states of the picture beside each other.
//
//   in   in_left, in_right  rgba32f
//   out  out_radiance       rgba32f  in_left left of the divider, else in_right
#version 450
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_left;
uniform sampler2D in_right;
uniform writeonly image2D out_radiance;

uniform float wipe_position;  // share of the width that is left of the divider

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const bool left = float(px.x) + 0.5 < wipe_position * float(frame.extent.x);
    imageStore(out_radiance, px, left ? texelFetch(in_left, px, 0) : texelFetch(in_right, px, 0));
}
