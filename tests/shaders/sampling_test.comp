// lib/sampling.glsl and bsdf/diffuse.glsl: densities, moments, bases, MIS weights.
#version 450
#include "expect.glsl"
#include "bsdf/diffuse.glsl"

const int N = 64;

// Moments of each warp over a midpoint grid against their closed forms.
void test_moments()
{
    const float opening = 0.3;
    vec3 cosine_mean = vec3(0.0), cone_mean = vec3(0.0);
    vec2 triangle_mean = vec2(0.0), triangle_second = vec2(0.0);
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) {
            const vec2 u = (vec2(i, j) + 0.5) / float(N);
            const float w = 1.0 / float(N * N);
            cosine_mean += w * sample_cosine_hemisphere(u);
            cone_mean += w * sample_cone(u, opening);
            const vec2 b = sample_triangle(u);
            triangle_mean += w * b;
            triangle_second += w * b * b;
            EXPECT_NEAR(length(sample_cosine_hemisphere(u)), 1.0, 1e-6);
            EXPECT_NEAR(length(sample_cone(u, opening)), 1.0, 1e-6);
            EXPECT_LE(1.0 - opening, sample_cone(u, opening).z + 1e-6);
            EXPECT_LE(b.x + b.y, 1.0 + 1e-6);
        }
    // 1e-3: error of the 64 x 64 midpoint rule for these integrands.
    EXPECT_NEAR(cosine_mean.z, 2.0 / 3.0, 1e-3);  // integral of cos^2 / pi
    EXPECT_NEAR(length(cosine_mean.xy), 0.0, 1e-3);
    EXPECT_NEAR(cone_mean.z, 1.0 - opening / 2.0, 1e-3);
    EXPECT_NEAR(triangle_mean.x, 1.0 / 3.0, 1e-3);
    EXPECT_NEAR(triangle_mean.y, 1.0 / 3.0, 1e-3);
    EXPECT_NEAR(triangle_second.x, 1.0 / 6.0, 1e-3);  // uniform density: E[b^2] = 1/6
    EXPECT_NEAR(triangle_second.y, 1.0 / 6.0, 1e-3);
}

// pdf integrates to one, eval * cos to the albedo (midpoint rule over cos(theta); phi is symmetric).
void test_diffuse()
{
    float pdf_integral = 0.0, albedo_integral = 0.0;
    for (int i = 0; i < N; ++i) {
        const float z = (float(i) + 0.5) / float(N);
        const vec3 wi = vec3(sqrt(1.0 - z * z), 0.0, z);
        pdf_integral += diffuse_pdf(z) * 2.0 * PI / float(N);
        albedo_integral += diffuse_eval(vec3(0.5), vec3(0.0, 0.0, 1.0), wi).x * z * 2.0 * PI / float(N);
    }
    EXPECT_NEAR(pdf_integral, 1.0, 1e-4);
    EXPECT_NEAR(albedo_integral, 0.5, 1e-4);
    EXPECT_EQ(diffuse_pdf(-0.1), 0.0);
    EXPECT_EQ(diffuse_eval(vec3(0.5), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0)).x, 0.0);
}

void test_basis()
{
    for (int i = 0; i < 200; ++i) {
        const float z = 1.0 - 2.0 * (float(i) + 0.5) / 200.0;
        const float phi = 2.4 * float(i);
        const vec3 n = i == 0 ? vec3(0.0, 0.0, -1.0) : vec3(sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z);
        const mat3 m = basis_around(n);
        const mat3 product = transpose(m) * m;
        for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
                EXPECT_NEAR(product[c][r], c == r ? 1.0 : 0.0, 2e-6);
        EXPECT_NEAR(dot(cross(m[0], m[1]), n), 1.0, 2e-6);
    }
}

void test_mis()
{
    EXPECT_NEAR(power_heuristic(1.0, 3.0), 0.1, 1e-6);
    EXPECT_NEAR(power_heuristic(2.0, 5.0) + power_heuristic(5.0, 2.0), 1.0, 1e-6);
    EXPECT_EQ(power_heuristic(0.0, 1.0), 0.0);
    EXPECT_EQ(power_heuristic(0.0, 0.0), 0.0);
    EXPECT_EQ(power_heuristic(1.0, 0.0), 1.0);
    EXPECT_NEAR(power_heuristic(1e30, 1e30), 0.5, 1e-6);  // squares would overflow
    EXPECT_NEAR(power_heuristic(1e-30, 1e-30), 0.5, 1e-6);
    EXPECT_EQ(power_heuristic(1e-38, 1e38), 0.0);
}

void main()
{
    test_moments();
    test_diffuse();
    test_basis();
    test_mis();
}
