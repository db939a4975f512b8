// Counts non-finite values before anything cleans them; the sum travels in every frame header and must be 0.
#pragma once
#include "lib/numbers.glsl"

layout(std430) buffer counter_block { uint nonfinite_count; };
