// bsdf/interior.glsl: which surfaces of nested and overlapping things are there, and how they bend light.
#version 450
#define FX_DIELECTRIC 1
#include "expect.glsl"
#include "bsdf/interior.glsl"

// Ranks among materials need packed ones: see lab/cases_media.cpp.
ShadedMaterial transparent(float ior, int priority)
{
    ShadedMaterial m;
    m.ior = ior;
    m.priority = priority;
    m.transmission = 1.0;
    m.thin_walled = false;
    return m;
}

void main()
{
    Interior i = outside_of_everything();
    const ShadedMaterial glass = transparent(1.5, 0);
    EXPECT_NEAR(boundary_at(i, glass, 0u, true).eta, 1.5, 1e-6);
    EXPECT_TRUE(boundary_at(i, glass, 0u, true).real);
    // Started inside of it: leaving leads to vacuum.
    EXPECT_NEAR(boundary_at(i, glass, 0u, false).eta, 1.0 / 1.5, 1e-6);
    EXPECT_TRUE(boundary_at(i, glass, 0u, false).real);

    EXPECT_TRUE(entered_after(uvec4(0u), 7u) == uvec4(7u, 0u, 0u, 0u));
    EXPECT_TRUE(entered_after(uvec4(1u, 2u, 3u, 0u), 7u) == uvec4(1u, 2u, 3u, 7u));
    EXPECT_TRUE(entered_after(uvec4(1u, 2u, 3u, 4u), 7u) == uvec4(1u, 2u, 3u, 4u));
    EXPECT_TRUE(without(uvec4(1u, 2u, 3u, 4u), 1u) == uvec4(2u, 3u, 4u, 0u));
    EXPECT_TRUE(without(uvec4(1u, 2u, 3u, 4u), 4u) == uvec4(1u, 2u, 3u, 0u));
    EXPECT_TRUE(without(uvec4(1u, 2u, 1u, 0u), 1u) == uvec4(1u, 2u, 0u, 0u));  // the later one
    EXPECT_TRUE(without(uvec4(1u, 2u, 0u, 0u), 9u) == uvec4(1u, 2u, 0u, 0u));

    // A thin wall has no inside; an opaque surface does not end one.
    ShadedMaterial wall = glass;
    wall.thin_walled = true;
    cross_boundary(i, wall, 3u, true);
    EXPECT_TRUE(i.entered == uvec4(0u));

    // A fifth entry is counted, and leaving it leaves nothing else.
    for (uint k = 0u; k < 5u; ++k)
        cross_boundary(i, glass, k, true);
    EXPECT_TRUE(i.entered == uvec4(1u, 2u, 3u, 4u));
    EXPECT_EQ(i.overflows, 1u);
    cross_boundary(i, glass, 4u, false);
    EXPECT_TRUE(i.entered == uvec4(1u, 2u, 3u, 4u));
    cross_boundary(i, glass, 1u, false);
    EXPECT_TRUE(i.entered == uvec4(1u, 3u, 4u, 0u));
}
