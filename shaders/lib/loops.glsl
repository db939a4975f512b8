// Whether the device has ended loops of this invocation before they were done: llvmpipe does so, without a word, after
// 65535 rounds of all of them together. What was traced then is not known.
#pragma once
#include "lib/frame.glsl"

// A loop of four rounds, which no compiler can foresee; where loops have run out it has two. To be asked last.
bool loops_ran_out()
{
    int rounds = 0;
    do {
        ++rounds;
    } while (rounds < 3 + int(min(frame.extent.x, 1u)));
    return rounds < 4;
}
