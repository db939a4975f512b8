// Counts values that no healthy frame has, by stage and kind, before anything cleans them: what is no number, endless,
// less than nothing, or cut at a limit. Of a pass it counts pixels; the counts travel in every frame header.
//
// An invocation notes what it meets and tells it once, at its end: healthy pixels pay for tests of bits, not for atomics.
#pragma once
#include "lib/frame.glsl"
#include "lib/numbers.glsl"
#include "shared/bad_values.h"

layout(std430) buffer counter_block { uint bad_value_counts[STAGE_COUNT * KIND_COUNT]; };
#ifdef PAINTS_BAD_VALUES
layout(std430) buffer painted_block { uint kinds_of_pixels[]; };  // a bit a kind, row by row
#endif

const uint IS_NAN = 1u << KIND_NAN;
const uint IS_INFINITE = 1u << KIND_INFINITE;
const uint IS_NEGATIVE = 1u << KIND_NEGATIVE;
const uint IS_CLAMPED = 1u << KIND_CLAMPED;

// A bit a kind, KIND_COUNT a stage, at its number modulo eight.
uint noted = 0u;

void note(uint stage, uint kinds) { noted |= kinds << (KIND_COUNT * (stage & 7u)); }

// Likewise, unless something was noted before: this may come of it.
void note_cause(uint stage, uint kinds) { note(stage, noted == 0u ? kinds : 0u); }

// The worst kind among numbers: `magnitude` is the largest of their bits less the signs', `least` the smallest number.
// -0 is none.
uint worst_kind(uint magnitude, float least)
{
    return magnitude > 0xff000000u ? IS_NAN
        : magnitude == 0xff000000u ? IS_INFINITE
        : least < 0.0              ? IS_NEGATIVE
                                   : 0u;
}

// Of what may be negative.
uint nonfinite_in(float x) { return worst_kind(floatBitsToUint(x) << 1u, 0.0); }

uint kinds_in(vec3 light)
{
    const uvec3 magnitude = floatBitsToUint(light) << 1u;
    return worst_kind(max(magnitude.x, max(magnitude.y, magnitude.z)), min(light.x, min(light.y, light.z)));
}

uint kinds_in(vec3 a, vec3 b)
{
    const uvec3 magnitude = max(floatBitsToUint(a) << 1u, floatBitsToUint(b) << 1u);
    const vec3 least = min(a, b);
    return worst_kind(max(magnitude.x, max(magnitude.y, magnitude.z)), min(least.x, min(least.y, least.z)));
}

// Tells what was noted at pixel px; `first`: no stage before it was noted.
void tell_noted(ivec2 px, uint first)
{
    uint left = noted;
    while (left != 0u) {
        const uint bit = uint(findLSB(left));
        const uint stage = first + ((bit / KIND_COUNT - first) & 7u);
        atomicAdd(bad_value_counts[stage * KIND_COUNT + bit % KIND_COUNT], 1u);
        left &= left - 1u;
    }
#ifdef PAINTS_BAD_VALUES
    uint kinds = noted | noted >> 16u;
    kinds |= kinds >> 8u;
    kinds = (kinds | kinds >> 4u) & 15u;
    if (kinds != 0u)
        atomicOr(kinds_of_pixels[px.y * int(frame.extent.x) + px.x], kinds);
#endif
}
