// Contact sheet: four views at half size.
//
//   in   in_top_left, in_top_right, in_bottom_left, in_bottom_right  rgba8
//   out  out_display  rgba8
#version 450
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_top_left;
uniform sampler2D in_top_right;
uniform sampler2D in_bottom_left;
uniform sampler2D in_bottom_right;
uniform writeonly image2D out_display;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const ivec2 half_extent = max(ivec2(frame.extent) / 2, ivec2(1));
    const bvec2 second = greaterThanEqual(px, half_extent);
    const ivec2 from = min((px - ivec2(second) * half_extent) * 2, ivec2(frame.extent) - 1);
    const vec4 top = second.x ? texelFetch(in_top_right, from, 0) : texelFetch(in_top_left, from, 0);
    const vec4 bottom = second.x ? texelFetch(in_bottom_right, from, 0) : texelFetch(in_bottom_left, from, 0);
    imageStore(out_display, px, second.y ? bottom : top);
}
