// geometry/ray.glsl: triangle and sphere tests against hand-computed hits, and shared edges.
#version 450
#include "expect.glsl"
#include "geometry/ray.glsl"

float triangle(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c)
{
    vec2 unused;
    return intersect_triangle(prepare(Ray(origin, direction)), a, b, c, T_INFINITY, unused);
}

float sphere(vec3 origin, vec3 direction, float radius)
{
    return intersect_sphere(prepare(Ray(origin, direction)), vec3(0.0), radius, 0.0, T_INFINITY);
}

void test_triangle()
{
    const vec3 a = vec3(0.0, 0.0, 0.0), b = vec3(1.0, 0.0, 0.0), c = vec3(0.0, 1.0, 0.0);
    vec2 barycentric;
    const Traversal ray = prepare(Ray(vec3(0.25, 0.5, 3.0), vec3(0.0, 0.0, -1.0)));
    EXPECT_NEAR(intersect_triangle(ray, a, b, c, T_INFINITY, barycentric), 3.0, 1e-6);
    EXPECT_NEAR(barycentric.x, 0.25, 1e-6);
    EXPECT_NEAR(barycentric.y, 0.5, 1e-6);
    EXPECT_LE(intersect_triangle(ray, a, b, c, 2.9, barycentric), 0.0);              // beyond t_max
    EXPECT_NEAR(triangle(vec3(0.25, 0.5, 3.0), vec3(0.0, 0.0, -1.0), a, c, b), 3.0, 1e-6);  // from behind
    EXPECT_LE(triangle(vec3(0.25, 0.5, -3.0), vec3(0.0, 0.0, -1.0), a, b, c), 0.0);  // behind the origin
    EXPECT_LE(triangle(vec3(0.6, 0.6, 3.0), vec3(0.0, 0.0, -1.0), a, b, c), 0.0);    // beside
    EXPECT_LE(triangle(vec3(0.25, 0.5, 3.0), vec3(1.0, 0.0, 0.0), a, b, c), 0.0);    // parallel
    EXPECT_LE(triangle(vec3(0.5, 0.0, 3.0), vec3(0.0, 0.0, -1.0), a, b, b), 0.0);    // zero area
    // All three axes can be the longest, with either sign; -0.0 is no trap.
    for (int axis = 0; axis < 3; ++axis)
        for (int s = -1; s <= 1; s += 2) {
            const vec3 n = permute(vec3(0.0, 0.0, 1.0), axis), u = permute(vec3(1.0, 0.0, 0.0), axis),
                       v = permute(vec3(0.0, 1.0, 0.0), axis);
            const vec3 direction = -float(s) * n;
            EXPECT_NEAR(triangle(float(s) * 2.0 * n + 0.2 * u + 0.3 * v, direction, vec3(0.0), u, v), 2.0, 1e-6);
        }
}

// Rays along the inside of a shared edge are caught by one of the neighbours.
void test_shared_edge()
{
    const vec3 a = vec3(-1.0, -1.0, 0.1), b = vec3(1.0, -1.0, -0.2), c = vec3(0.9, 1.1, 0.3), d = vec3(-1.2, 0.8, 0.0);
    for (int i = 0; i < 200; ++i) {
        const vec3 target = mix(a, c, (float(i) + 1.0) / 202.0);
        const vec3 origin = vec3(0.3, -0.2, 5.0);
        const vec3 direction = normalize(target - origin);
        EXPECT_TRUE(triangle(origin, direction, a, b, c) > 0.0 || triangle(origin, direction, a, c, d) > 0.0);
    }
}

void test_sphere()
{
    EXPECT_NEAR(sphere(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, -1.0), 1.0), 2.0, 1e-6);
    EXPECT_NEAR(sphere(vec3(0.0), vec3(0.0, 0.0, -1.0), 1.0), 1.0, 1e-6);  // from the middle
    EXPECT_LE(sphere(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, 1.0), 1.0), 0.0);
    EXPECT_LE(sphere(vec3(0.0, 1.01, 3.0), vec3(0.0, 0.0, -1.0), 1.0), 0.0);
    // Far away, where b^2 - 4 a c has no digits left: a hit 0.5 off the middle of a unit sphere at distance 1e4.
    EXPECT_NEAR(sphere(vec3(0.5, 0.0, 1e4), vec3(0.0, 0.0, -1.0), 1.0), 1e4 - sqrt(0.75), 2e-3);  // 2 ulp of 1e4
    EXPECT_LE(sphere(vec3(1.001, 0.0, 1e4), vec3(0.0, 0.0, -1.0), 1.0), 0.0);
}

void test_slab_directions()
{
    const Traversal t = prepare(Ray(vec3(0.0), vec3(0.0, -0.0, 1.0)));
    EXPECT_TRUE(is_finite(t.inverse_direction.x) && is_finite(t.inverse_direction.y));
    EXPECT_EQ(t.inverse_direction.z, 1.0);
}

void main()
{
    test_triangle();
    test_shared_edge();
    test_sphere();
    test_slab_directions();
}
