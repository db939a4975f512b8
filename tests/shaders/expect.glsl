// EXPECT_* for GLSL: the first failing line, with what was found and expected, lands in `output_block`.
//   output[0] = (checks done, failures, line of the first failure, 0)
//   output[1] = (found, expected, tolerance, 0) of the first failure
#pragma once

layout(local_size_x = 1) in;
layout(std430) buffer output_block { vec4 results[]; };

void check(bool ok, float found, float expected, float tolerance, int line)
{
    results[0].x += 1.0;
    if (ok)
        return;
    if (results[0].y == 0.0) {
        results[0].z = float(line);
        results[1] = vec4(found, expected, tolerance, 0.0);
    }
    results[0].y += 1.0;
}

#define EXPECT_NEAR(found, expected, tolerance) \
    check(abs((found) - (expected)) <= (tolerance), found, expected, tolerance, __LINE__)
#define EXPECT_EQ(found, expected) check((found) == (expected), float(found), float(expected), 0.0, __LINE__)
#define EXPECT_TRUE(condition) check(condition, 0.0, 1.0, 0.0, __LINE__)
#define EXPECT_LE(smaller, larger) check((smaller) <= (larger), smaller, larger, 0.0, __LINE__)
