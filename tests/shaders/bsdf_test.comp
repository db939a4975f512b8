// bsdf/bsdf.glsl without any effect: a Lambertian reflector, sampled with the density that is claimed.
#version 450
#include "expect.glsl"
#include "bsdf/bsdf.glsl"

void main()
{
    ShadedMaterial m;
    m.albedo = vec3(0.25, 0.5, 1.0);
    m.shading_normal = normalize(vec3(0.3, -0.2, 0.7));
    const vec3 up = m.shading_normal;
    const vec3 view = normalize(up + vec3(0.4, 0.1, 0.0));
    const Bsdf b = make_bsdf(m, up, view, 1.0);
    const vec3 wo = to_local(b, view);
    EXPECT_NEAR(wo.z, dot(up, view), 1e-6);
    EXPECT_LE(length(to_world(b, wo) - view), 1e-6);
    for (int i = 0; i < 64; ++i) {
        const vec4 u = vec4((float(i) + 0.5) / 64.0, fract(float(i) * 0.618), 0.0, 0.3);
        const BsdfSample s = bsdf_sample(b, wo, u);
        EXPECT_TRUE(!s.delta && !s.transmitted && s.diffuse);
        EXPECT_LE(length(s.weight - m.albedo), 1e-6);
        EXPECT_NEAR(s.pdf, bsdf_pdf(b, wo, s.wi), 1e-7);
        EXPECT_NEAR(bsdf_eval(b, wo, s.wi).y, m.albedo.y * s.wi.z * INV_PI, 1e-7);
        EXPECT_EQ(bsdf_eval(b, wo, -s.wi).y, 0.0);
        EXPECT_EQ(bsdf_pdf(b, wo, -s.wi), 0.0);
    }
}
