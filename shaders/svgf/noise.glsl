// What the filter carries along of a signal's noise, two luminances in the word beside its colour:
//   upper half  variance, as a bfloat16 of at least 2^-126, so that no word is a denormal that a device may flush
//   lower half  half difference (A - B) / 2, as a bfloat16
//
// A and B are what the filter makes of every other sample, the squares of a chessboard whose colours swap after every
// second frame, with the very weights that make the picture (A + B) / 2 of both. Where samples are independent the half difference is thus
// as far from zero as the picture is from its own mean: an estimate of its noise without any reference, and without
// the assumption, false from the second a-trous iteration on, that taps do not share samples.
// Source: the half buffers of Rousselle et al. 2012, "Adaptive Rendering with Non-Local Means Filtering", section 4;
// here as one signed buffer, which follows temporal filters too.
#pragma once

#include "lib/frame.glsl"

// Which half this frame's sample of a pixel belongs to: A where positive.
float half_sign(ivec2 px) { return ((px.x + px.y + int(frame.frame_index >> 1u)) & 1) == 0 ? 1.0 : -1.0; }

// To the nearest, ties to even.
uint bfloat16(float x)
{
    const uint bits = floatBitsToUint(x);
    return (bits + 0x7fffu + ((bits >> 16u) & 1u)) >> 16u;
}

const float MOST_VARIANCE = 1e38;

float pack_noise(float variance, float half_difference)
{
    const uint upper = bfloat16(clamp(variance, 1.1755e-38, MOST_VARIANCE)) << 16u;
#ifdef ERROR_ESTIMATE
    return uintBitsToFloat(upper | bfloat16(half_difference));
#else
    return uintBitsToFloat(upper);
#endif
}

float variance_in(float word) { return uintBitsToFloat(floatBitsToUint(word) & 0xffff0000u); }
float half_difference_in(float word) { return uintBitsToFloat(floatBitsToUint(word) << 16u); }
