// What bsdf/bsdf.glsl does with one material seen at one angle: samples, or its density and value summed over the bins
// of a histogram. Driven by bsdf_sampling_test.cpp, which says what `probe` holds.
#version 450
#include "bsdf/bsdf.glsl"
#include "lib/random.glsl"

layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer probe;

vec4 parameter(int at) { return uintBitsToFloat(texelFetch(probe, at)); }

float alpha_of_probe(float roughness) { return roughness > MIRROR_ROUGHNESS ? roughness * roughness : 0.0; }

Bsdf probed(out vec3 wo)
{
    const vec4 a = parameter(0), b = parameter(1), c = parameter(2), d = parameter(3), e = parameter(4);
    ShadedMaterial m;
    m.albedo = a.rgb;
    m.emission = vec3(0.0);
    m.shading_normal = vec3(0.0, 0.0, 1.0);
#ifdef FX_UNLIT
    m.unlit = false;
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    m.metallic = a.w;
    m.alpha = alpha_of_probe(b.x);
    m.specular = b.y;
    m.ior = max(b.z, 1.0 / b.z);
    m.specular_color = c.rgb;
#endif
#ifdef FX_DIELECTRIC
    m.transmission = b.w;
    m.thin_walled = c.w != 0.0;
    m.absorption = vec3(0.0);
    m.priority = 0;
#endif
#ifdef FX_CLEARCOAT
    m.clearcoat = d.x;
    m.clearcoat_alpha = alpha_of_probe(d.y);
    m.clearcoat_normal = normalize(vec3(parameter(5).xy, 1.0));
#endif
    wo = vec3(sqrt(max(0.0, 1.0 - d.z * d.z)), 0.0, d.z);
    return make_bsdf(m, e.xyz, wo, b.z);
}

#ifdef PROBE_SAMPLES
// Two texels a sample: wi and 1 for a direction, 2 for one of a delta lobe, 0 for none; weight and pdf.
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    vec3 wo;
    const Bsdf b = probed(wo);
    const vec4 u = random4(uvec2(i, 0u), uint(parameter(4).w), 0u, 0u, SLOT_BSDF);
    const BsdfSample s = bsdf_sample(b, wo, u);
    const bool usable = max_component(s.weight) > 0.0;
    results[2u * i] = vec4(s.wi, usable ? (s.delta ? 2.0 : 1.0) : 0.0);
    results[2u * i + 1u] = vec4(s.weight, s.pdf);
}
#elif defined(PROBE_VALUES)
// Two texels a random direction all around: diffuse value and pdf, specular value.
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    vec3 wo;
    const Bsdf b = probed(wo);
    const vec2 u = random4(uvec2(i, 1u), uint(parameter(4).w), 0u, 0u, SLOT_LIGHT).xy;
    const BsdfValue v = bsdf_evaluate(b, wo, sample_cone(u, 2.0));
    results[2u * i] = vec4(v.diffuse, v.pdf);
    results[2u * i + 1u] = vec4(v.specular, 0.0);
}
#else
// Bins around an axis on either side of the surface. Their radius x in [0, 1] grows with the logarithm of the angle:
// sin(angle / 2) = scale * ((1 + 1 / scale)^x - 1). A texel a bin: pdf and value integrated.
const int SUB = 32;

void main()
{
    const uint bin = gl_GlobalInvocationID.x;
    vec3 wo;
    const Bsdf b = probed(wo);
    const uint rings = uint(parameter(5).z), sectors = uint(parameter(5).w);
    const bool above = bin < rings * sectors;
    const vec4 axis = parameter(above ? 6 : 7);
    const uint inside = bin % (rings * sectors);
    const vec2 corner = vec2(inside / sectors, inside % sectors);
    const mat3 frame = basis_around(axis.xyz);
    const vec3 geometric_normal = parameter(4).xyz;
    const float decades = log(1.0 + 1.0 / axis.w);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < SUB; ++i)
        for (int j = 0; j < SUB; ++j) {
            const vec2 x = (corner + (vec2(i, j) + 0.5) / float(SUB)) / vec2(rings, sectors);
            const float rho = axis.w * (exp(x.x * decades) - 1.0);
            const float measure = 4.0 * rho * (axis.w + rho) * decades * 2.0 * PI;
            const float sin_theta = 2.0 * rho * sqrt(max(0.0, 1.0 - rho * rho));
            const float phi = 2.0 * PI * x.y;
            const vec3 wi = frame * vec3(sin_theta * cos(phi), sin_theta * sin(phi), 1.0 - 2.0 * rho * rho);
            const BsdfValue v = bsdf_evaluate(b, wo, wi);
            const bool counts = (dot(geometric_normal, wi) > 0.0) == above;
            if (counts)
                sum += measure * vec4(v.pdf, v.diffuse + v.specular);
        }
    results[bin] = sum / float(rings * sectors * uint(SUB * SUB));
}
#endif
