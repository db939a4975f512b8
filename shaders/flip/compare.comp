// FLIP, last pass: the difference of two pictures as a person sees it who alternates them on a screen.
//
//   in   test_seen         rgba32f  flip/filter.comp, DOWN
//        test_points       r32f     likewise
//        reference_seen    rgba32f
//        reference_points  r32f
//   out  out_map           r32f     error in [0, 1]
//
// Source: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", sections 4.2 and 4.3.
#version 450
#include "flip/color.glsl"
#include "lib/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D test_seen;
uniform sampler2D test_points;
uniform sampler2D reference_seen;
uniform sampler2D reference_points;
uniform writeonly image2D out_map;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const vec4 test = texelFetch(test_seen, px, 0);
    const vec4 reference = texelFetch(reference_seen, px, 0);
    const float points = abs(texelFetch(test_points, px, 0).r - texelFetch(reference_points, px, 0).r);
    const float feature = max(abs(test.a - reference.a), points);
    const float color = color_difference(test.rgb, reference.rgb);
    // E = color^(1 - feature^q_f), q_f = 1/2.
    imageStore(out_map, px, vec4(color > 0.0 ? pow(color, 1.0 - sqrt(feature / sqrt(2.0))) : 0.0));
}
