// Display values as the server computes them, of the numbers in `probe`: curve and sRGB (x), sRGB alone (y). Driven by
// display_values_test.cpp.
#version 450
#include "lib/display.glsl"

layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform samplerBuffer probe;

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= uint(textureSize(probe)))
        return;
    const vec3 x = displayable(vec3(texelFetch(probe, int(i)).r));
    results[i] = vec4(srgb_encode(aces_curve(x)).x, srgb_encode(min(x, vec3(1.0))).x, 0.0, 0.0);
}
