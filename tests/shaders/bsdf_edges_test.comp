// bsdf/bsdf.glsl at the edge of what there is: grazing, index 1, the sharpest lobes, equal and opposite directions.
#version 450
#define FX_ROUGH_REFLECTION 1
#define FX_MIRROR 1
#define FX_DIELECTRIC 1
#define FX_ROUGH_DIELECTRIC 1
#include "expect.glsl"
#include "bsdf/bsdf.glsl"

ShadedMaterial conductor(float alpha)
{
    ShadedMaterial m;
    m.albedo = vec3(0.9, 0.6, 0.3);
    m.emission = vec3(0.0);
    m.shading_normal = vec3(0.0, 0.0, 1.0);
    m.metallic = 1.0;
    m.alpha = alpha;
    m.specular = 1.0;
    m.ior = 1.5;
    m.specular_color = vec3(1.0);
    m.transmission = 0.0;
    m.thin_walled = false;
    m.absorption = vec3(0.0);
    m.priority = 0;
    return m;
}

vec3 direction(float z, float phi) { return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z); }

bool sound(vec3 v) { return all_finite(v) && all(greaterThanEqual(v, vec3(0.0))); }

// Nothing is negative or not a number, and no single sample weighs more than a handful.
void test_edges()
{
    const float heights[8] = float[](0.0, 1e-7, 1e-5, 1e-3, 0.1, 0.5, 0.99999994, 1.0);
    const float alphas[5] = float[](0.0, GGX_ALPHA_MIN, 0.01, 0.5, 1.0);
    const float etas[4] = float[](1.0, 1.0000001, 1.5, 1.0 / 2.4);
    for (int k = 0; k < 60; ++k) {
        ShadedMaterial m = conductor(alphas[k % 5]);
        const float eta = etas[(k / 5) % 4];
        m.metallic = k < 20 ? 1.0 : k < 40 ? 0.0 : 0.3;
        m.transmission = k < 40 ? 1.0 : 0.5;
        m.albedo = k % 7 == 0 ? vec3(0.0) : vec3(1.0);
        m.thin_walled = k % 3 == 0;
        for (int i = 0; i < 8; ++i) {
            const vec3 wo = direction(heights[i], 0.0);
            const Bsdf b = make_bsdf(m, vec3(0.0, 0.0, 1.0), wo, eta);
            for (int j = 0; j < 8; ++j)
                for (int side = -1; side <= 1; side += 2) {
                    const vec3 wi = direction(float(side) * heights[j], j == i ? 0.0 : 2.0);
                    const BsdfValue v = bsdf_evaluate(b, wo, wi);
                    EXPECT_TRUE(sound(v.diffuse) && sound(v.specular) && is_finite(v.pdf) && v.pdf >= 0.0);
                }
            const BsdfValue same = bsdf_evaluate(b, wo, wo);
            EXPECT_TRUE(sound(same.diffuse + same.specular) && is_finite(same.pdf));
            const BsdfValue straight = bsdf_evaluate(b, wo, -wo);
            EXPECT_TRUE(sound(straight.diffuse + straight.specular) && is_finite(straight.pdf));
            for (int n = 0; n < 16; ++n) {
                const vec4 u = vec4(fract(float(n) * 0.618), n == 0 ? 0.99999994 : n == 1 ? 0.0 : fract(float(n) * 0.3819), 0.5,
                    n == 2 ? 0.99999994 : fract(float(n) * 0.27));
                const BsdfSample s = bsdf_sample(b, wo, u);
                EXPECT_TRUE(sound(s.weight) && is_finite(s.pdf) && s.pdf >= 0.0 && all_finite(s.wi));
                EXPECT_LE(max_component(s.weight), 4.0);
                EXPECT_NEAR(length(s.wi), 1.0, 1e-5);
            }
        }
    }
}

void main() { test_edges(); }
