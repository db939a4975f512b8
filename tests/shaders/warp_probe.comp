// Samples of one warp: WARP is an expression of u, two random numbers, and of p and q, what `probe` holds. Driven by
// warp_sampling_test.cpp.
#version 450
#include "lib/random.glsl"
#include "media/fog.glsl"

layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer probe;

Fog fog_of(vec4 p, vec4 q) { return Fog(p.xyz, p.xyz, q.x, vec3(0.0), 1.0); }

vec4 told(FogEvent e) { return vec4(e.way, e.scattered ? 1.0 : 0.0, 0.0, 0.0); }

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    const vec4 p = uintBitsToFloat(texelFetch(probe, 0)), q = uintBitsToFloat(texelFetch(probe, 1));
    const vec2 u = random4(uvec2(i, 0u), 1u, 0u, 0u, SLOT_BSDF).xy;
    results[i] = WARP;
}
