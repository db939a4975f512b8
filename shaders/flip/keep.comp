// The FLIP map of before, once more.
//
//   in   prev_map  r32f
//   out  out_map   r32f  feeds back next frame as prev_map
#version 450
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D prev_map;
uniform writeonly image2D out_map;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (inside_frame(px))
        imageStore(out_map, px, texelFetch(prev_map, px, 0));
}
