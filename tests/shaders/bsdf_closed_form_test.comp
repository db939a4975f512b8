// Fresnel's equations, GGX and its albedo against values in closed form or by independent quadrature; and
// reciprocity.
#version 450
#define FX_ROUGH_REFLECTION 1
#define FX_MIRROR 1
#define FX_DIELECTRIC 1
#include "expect.glsl"
#include "bsdf/bsdf.glsl"

void test_fresnel()
{
    EXPECT_NEAR(fresnel_dielectric(1.0, 1.5), 0.04, 1e-7);
    EXPECT_NEAR(fresnel_dielectric(1.0, 1.0 / 1.5), 0.04, 1e-7);
    EXPECT_NEAR(fresnel_normal(1.5), 0.04, 1e-8);
    EXPECT_NEAR(fresnel_dielectric(cos(radians(56.309932)), 1.5), 0.073964, 1e-6);  // Brewster: half of one polarisation
    EXPECT_EQ(fresnel_dielectric(0.0, 1.5), 1.0);
    EXPECT_NEAR(fresnel_dielectric(1e-4, 1.5), 1.0, 1e-3);
    // Critical angle 41.8103 degrees.
    EXPECT_EQ(fresnel_dielectric(cos(radians(41.8105)), 1.0 / 1.5), 1.0);
    EXPECT_LE(fresnel_dielectric(cos(radians(41.80)), 1.0 / 1.5), 0.97);
    EXPECT_EQ(refracted_cosine(cos(radians(41.8105)), 1.0 / 1.5), 0.0);
    EXPECT_NEAR(slab_reflectance(vec3(fresnel_dielectric(1.0, 1.5))).x, 0.076923, 1e-6);
    // No interface: nothing is reflected, down to the last degree.
    EXPECT_EQ(fresnel_dielectric(0.5, 1.0), 0.0);
    EXPECT_EQ(fresnel_dielectric(1e-6, 1.0), 0.0);
    EXPECT_NEAR(schlick_weight(0.5), 1.0 / 32.0, 1e-8);
    // Hemispherical means, 2 times the integral of F cos dcos, by the midpoint rule.
    float out_in = 0.0, in_out = 0.0;
    const int n = 2048;
    for (int i = 0; i < n; ++i) {
        const float c = (float(i) + 0.5) / float(n);
        out_in += fresnel_dielectric(c, 1.5) * 2.0 * c / float(n);
        in_out += fresnel_dielectric(c, 1.0 / 1.5) * 2.0 * c / float(n);
    }
    EXPECT_NEAR(out_in, 0.091778, 2e-6);
    EXPECT_NEAR(in_out, 0.596346, 3e-5);  // kinks at the critical angle
    // The same energy crosses either way: (1 - in_out) = (1 - out_in) / n^2.
    EXPECT_NEAR((1.0 - in_out) * 2.25, 1.0 - out_in, 1e-4);
}

void test_refraction()
{
    for (int i = 1; i < 50; ++i) {
        const float z = float(i) / 50.0;
        const vec3 wo = vec3(sqrt(1.0 - z * z), 0.0, z);
        const vec3 wi = refracted(wo, vec3(0.0, 0.0, 1.0), 1.5);
        EXPECT_NEAR(length(wi), 1.0, 3e-7);
        EXPECT_NEAR(wi.x, -wo.x / 1.5, 1e-7);  // Snell
        EXPECT_TRUE(wi.z < 0.0);
        // And back.
        const vec3 back = refracted(-wi * vec3(1.0, 1.0, -1.0) * vec3(1.0, 1.0, 1.0), vec3(0.0, 0.0, 1.0), 1.0 / 1.5);
        EXPECT_NEAR(abs(back.x), abs(wo.x), 1e-6);
        EXPECT_LE(length(refracted(wo, vec3(0.0, 0.0, 1.0), 1.0) + wo), 3e-7);
    }
}

// Single-scattering albedo of GGX with all light reflected, by sampling visible normals on a lattice.
float albedo(float mu, float alpha)
{
    const vec3 wo = vec3(sqrt(1.0 - mu * mu), 0.0, mu);
    float sum = 0.0, weights = 0.0;
    const int n = 987;  // Fibonacci lattice; llvmpipe ends all loops of an invocation after 65535 rounds in all
    for (int i = 0; i < n; ++i) {
        // Cubed towards the tail, which is all that a smooth surface loses.
        const float v = (float(i) + 0.5) / float(n);
        const float u = fract(float(i) * 0.38196601);
        const vec3 h = ggx_sample_visible_normal(wo, alpha, vec2(u, 1.0 - v * v * v));
        const vec3 wi = reflected(wo, h);
        const float so = ggx_stretch(wo, alpha);
        const float g = wi.z > 0.0 ? ggx_shadowing_over_cosine(wo.z, so, wi.z, ggx_stretch(wi, alpha)) : 0.0;
        sum += v * v * g / ggx_visibility(wo.z, so);
        weights += v * v;
    }
    return sum / weights;
}

// A test for "at most 1" is blind to a factor of 2; these values are not.
void test_albedo()
{
    const float alphas[5] = float[](0.001, 0.1, 0.25, 0.5, 1.0);
    const float cosines[5] = float[](1.0, 0.7, 0.3, 0.1, 0.05);
    const float expected[25] = float[](1.0, 1.0, 1.0, 0.9999, 0.9998,  //
        0.9883, 0.9814, 0.9363, 0.8835, 0.9118,                        //
        0.9158, 0.8853, 0.8379, 0.8916, 0.9331,                        //
        0.6879, 0.6830, 0.7453, 0.8601, 0.9126,                        //
        0.3069, 0.3789, 0.5601, 0.7602, 0.8478);
    for (int a = 0; a < 5; ++a) {
        for (int c = 0; c < 5; ++c)
            EXPECT_NEAR(albedo(cosines[c], alphas[a]), expected[5 * a + c], 4e-4);  // 4 digits, and the lattice
    }
}

vec3 direction(float z, float phi) { return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z); }

// Single scattering is reciprocal: f(a, b) = f(b, a). (Compensated lobes and layers are scaled by the viewer's angle.)
void test_reciprocity()
{
    float unused;
    for (int i = 0; i < 60; ++i) {
        const vec3 a = direction(0.02 + 0.016 * float(i), 0.3);
        const vec3 b = direction(0.9 - 0.013 * float(i), 0.3 + 0.1 * float(i));
        for (int k = 1; k <= 4; ++k) {
            const float alpha = 0.25 * float(k);
            const float f_ab = ggx_reflection(a, b, alpha, unused).x / b.z;
            const float f_ba = ggx_reflection(b, a, alpha, unused).x / a.z;
            EXPECT_NEAR(f_ab, f_ba, 1e-4 * f_ba);
            EXPECT_TRUE(f_ab > 0.0);
        }
    }
}

void main()
{
    test_fresnel();
    test_refraction();
    test_albedo();
    test_reciprocity();
}
