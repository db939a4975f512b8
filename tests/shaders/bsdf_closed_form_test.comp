// Fresnel's equations and refraction against values in closed form. More of it: lab/cases_bsdf.cpp.
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

void main()
{
    test_fresnel();
    test_refraction();
}
