// Counts non-finite values before anything cleans them; the sum travels in every frame header and must be 0.
#pragma once
#include "lib/numbers.glsl"

layout(std430) buffer counter_block { uint nonfinite_count; };

// The value itself if it is finite; else it is counted and black.
vec3 counted_finite(vec3 value)
{
    if (all_finite(value))
        return value;
    atomicAdd(nonfinite_count, 1u);
    return vec3(0.0);
}

vec4 counted_finite(vec4 value) { return vec4(counted_finite(value.xyz), counted_finite(value.www).x); }
