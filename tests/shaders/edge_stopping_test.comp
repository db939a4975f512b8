// svgf/surface.glsl: the geometry weights of eq. 3 and 4, at values worked out by hand.
#version 450
#include "expect.glsl"
#include "svgf/surface.glsl"

void main()
{
    const vec3 n = vec3(0.0, 0.0, 1.0);
    // Depth 10 m, 0.5 m per pixel along x. The floor adds a tenth of the footprint, 0.1 * 2/64 * 10, per pixel.
    const FilterSurface p = FilterSurface(10.0, vec2(0.5, 0.0), n);
    const float floor_per_pixel = 0.1 * 2.0 / 64.0 * 10.0;
    EXPECT_EQ(depth_weight_exponent(p, 10.0, vec2(2.0, 0.0), 1.0), 0.0);
    EXPECT_NEAR(depth_weight_exponent(p, 11.0, vec2(2.0, 0.0), 1.0), 1.0 / (1.0 + 2.0 * floor_per_pixel), 1e-5);
    EXPECT_NEAR(depth_weight_exponent(p, 9.0, vec2(-2.0, 0.0), 4.0), 1.0 / (4.0 + 2.0 * floor_per_pixel), 1e-5);
    EXPECT_NEAR(depth_weight_exponent(p, 10.1, vec2(0.0, 1.0), 1.0), 0.1 / floor_per_pixel, 1e-3);
    EXPECT_EQ(depth_weight_exponent(p, 10.0, vec2(0.0), 1.0), 0.0);
    // The same at any scale of the scene.
    const FilterSurface large = FilterSurface(10.0 * 1024.0, vec2(0.5, 0.0) * 1024.0, n);
    EXPECT_EQ(depth_weight_exponent(p, 11.0, vec2(2.0, 1.0), 1.0),
        depth_weight_exponent(large, 11.0 * 1024.0, vec2(2.0, 1.0), 1.0));

    EXPECT_NEAR(exp(-normal_weight_exponent(n, n, 128.0)), 1.0, 1e-6);
    EXPECT_NEAR(exp(-normal_weight_exponent(n, vec3(0.6, 0.0, 0.8), 2.0)), 0.64, 1e-5);
    EXPECT_NEAR(exp(-normal_weight_exponent(n, vec3(0.0, 0.0, -1.0), 128.0)), 0.0, 1e-6);
    EXPECT_NEAR(exp(-normal_weight_exponent(n, vec3(1.0, 0.0, 0.0), 0.0)), 1.0, 1e-6);
    EXPECT_TRUE(is_finite(normal_weight_exponent(n, vec3(0.0, 0.0, 1.0000005), 1024.0)));
}
