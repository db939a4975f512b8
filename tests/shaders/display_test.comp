// lib/display.glsl: total functions into [0, 1], monotone, and the sRGB curve at published points.
#version 450
#include "expect.glsl"
#include "lib/display.glsl"

void main()
{
    const float infinity = uintBitsToFloat(0x7f800000u), nan = uintBitsToFloat(0x7fc00000u);
    const float special[8] = float[](0.0, -1.0, -infinity, infinity, nan, 1e30, 3.4e38, 1e-40);
    for (int i = 0; i < 8; ++i) {
        const float y = srgb_encode(aces_curve(displayable(vec3(special[i])))).x;
        EXPECT_TRUE(y >= 0.0 && y <= 1.0);
    }
    EXPECT_EQ(displayable(vec3(nan)).x, 0.0);
    EXPECT_NEAR(aces_curve(displayable(vec3(infinity))).x, 1.0, 1e-6);

    float previous = -1.0;
    for (int i = 0; i < 2000; ++i) {
        const float x = exp2(float(i) * 0.02 - 20.0);
        const float y = srgb_encode(aces_curve(vec3(x))).x;
        EXPECT_LE(previous, y + 1e-6);
        previous = y;
    }
    EXPECT_NEAR(aces_curve(vec3(0.5)).x, 0.5 * (2.51 * 0.5 + 0.03) / (0.5 * (2.43 * 0.5 + 0.59) + 0.14), 1e-6);
    EXPECT_NEAR(srgb_encode(vec3(0.0)).x, 0.0, 1e-7);
    EXPECT_NEAR(srgb_encode(vec3(0.214041)).x, 0.5, 1e-5);
    EXPECT_NEAR(srgb_encode(vec3(1.0)).x, 1.0, 1e-6);
    EXPECT_NEAR(srgb_encode(vec3(0.002)).x, 12.92 * 0.002, 1e-7);
}
