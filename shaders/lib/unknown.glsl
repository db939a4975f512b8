// Light that nobody knows: what a path tracer could not tell, or a value that is none. Every stage leaves it out instead
// of taking it for black, so that one bad number darkens nothing and is gone with the next frame.
#pragma once
#include "lib/counters.glsl"

// -0: nothing in a sum, and told apart from black by is_light().
vec3 unknown_light() { return vec3(uintBitsToFloat(0x80000000u)); }

// What a stage has worked out, where it is light; else it is noted and unknown from here on.
vec3 counted_light(uint stage, vec3 value)
{
    const uint kinds = kinds_in(value);
    note(stage, kinds);
    return kinds == 0u ? abs(value) : unknown_light();
}

// Light of an invocation that has met nothing bad.
vec3 light_if_known(vec3 light) { return noted == 0u ? abs(light) : unknown_light(); }

// Whether a stage has been given light. What is neither that nor left out by an earlier stage is noted.
bool counted_known(uint stage, vec3 given)
{
    note(stage, kinds_in(given));
    return is_light(given);
}
