// Light that nobody knows: what a path tracer could not tell, or a value that is none. Every stage leaves it out instead
// of taking it for black, so that one bad number darkens nothing and is gone with the next frame.
#pragma once
#include "lib/counters.glsl"

// -0: nothing in a sum, and told apart from black by is_light().
vec3 unknown_light() { return vec3(uintBitsToFloat(0x80000000u)); }

// What a stage has worked out, where it is light; else it is counted and unknown from here on.
vec3 counted_light(vec3 value)
{
    if (all(greaterThanEqual(value, vec3(0.0))) && all_finite(value))
        return abs(value);
    atomicAdd(nonfinite_count, 1u);
    return unknown_light();
}

// Whether a stage has been given light. What is neither that nor left out by an earlier stage is counted.
bool counted_known(bool known, vec3 given)
{
    const uvec3 magnitude = floatBitsToUint(given) << 1u;
    if (!known && max(magnitude.x, max(magnitude.y, magnitude.z)) != 0u)
        atomicAdd(nonfinite_count, 1u);
    return known;
}
