// lib/packing.glsl and lib/random.glsl: unit vectors survive 32 bits, random numbers are what they claim.
#version 450
#include "expect.glsl"
#include "lib/packing.glsl"
#include "lib/random.glsl"

void test_octahedral()
{
    for (int i = 0; i < 1000; ++i) {
        const float z = 1.0 - 2.0 * (float(i) + 0.5) / 1000.0;
        const float phi = 2.4 * float(i);
        const vec3 n = vec3(sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z);
        EXPECT_LE(length(unpack_octahedral(pack_octahedral(n)) - n), 1e-4);  // 16-bit grid: 2^-15 * sqrt(3) * 1.5
    }
    for (int axis = 0; axis < 3; ++axis)
        for (int s = -1; s <= 1; s += 2) {
            vec3 n = vec3(0.0);
            n[axis] = float(s);
            EXPECT_LE(length(unpack_octahedral(pack_octahedral(n)) - n), 1e-6);
        }
}

// Mean and variance of each of the four numbers, and their correlation, over 4096 samples. Fixed seeds; the bounds
// are 4 standard errors, which 28 checks would exceed by chance in 1 of 560 seeds.
void test_random()
{
    for (uint seed = 0u; seed < 2u; ++seed) {
        vec4 sum = vec4(0.0), square = vec4(0.0);
        float product = 0.0;
        for (uint i = 0u; i < 4096u; ++i) {
            const vec4 u = random4(uvec2(i % 64u, i / 64u), seed, 4294967295u - i, 3u, SLOT_BSDF);
            EXPECT_TRUE(all(greaterThanEqual(u, vec4(0.0))) && all(lessThan(u, vec4(1.0))));
            sum += u;
            square += u * u;
            product += (u.x - 0.5) * (u.y - 0.5);
        }
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(sum[k] / 4096.0, 0.5, 4.0 * 0.2887 / 64.0);
            EXPECT_NEAR(square[k] / 4096.0, 1.0 / 3.0, 4.0 * 0.2981 / 64.0);
        }
        EXPECT_NEAR(product / 4096.0, 0.0, 4.0 * 0.0833 / 64.0);
    }
    // The largest hash stays below 1; slots, samples and seeds differ.
    EXPECT_LE(float(0xffffffffu >> 8u) * exp2(-24.0), 0.99999999);
    const vec4 u = random4(uvec2(5u), 1u, 7u, 0u, SLOT_BSDF);
    EXPECT_TRUE(u != random4(uvec2(5u), 1u, 7u, 0u, SLOT_LIGHT));
    EXPECT_TRUE(u != random4(uvec2(5u), 1u, 8u, 0u, SLOT_BSDF));
    EXPECT_TRUE(u != random4(uvec2(5u), 2u, 7u, 0u, SLOT_BSDF));
    EXPECT_TRUE(u != random4(uvec2(5u), 1u, 16777216u, 0u, SLOT_BSDF));
}

void main()
{
    test_octahedral();
    test_random();
}
