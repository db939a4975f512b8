// How a surface scatters light: one set of functions over all lobes that are compiled.
//
// Directions are unit vectors in the local frame of the shading normal (z), both pointing away from the surface:
//   wo  towards the viewer, on the side of the geometric normal      wi  towards the light
// Get one with make_bsdf() for a vertex and its wo; its lobes' weights hold for that wo alone.
//
// *Values include the cosine*: bsdf_eval() is f * |cos|, so that directions folded back above the geometric surface
// need no division by a cosine that may be zero. Densities are per solid angle [1/sr]. Delta lobes are in bsdf_sample()
// only. Transmitted radiance is basic radiance, L / n^2: every interface is then lossless by itself, and what is
// seen from outside is the same.
#pragma once
#include "bsdf/diffuse.glsl"
#include "materials/shaded_material.glsl"

struct Bsdf {
    mat3 frame;             // world from local
    vec3 geometric_normal;  // local, unit, on the viewer's side
    vec3 albedo;            // of the diffuse lobe; set it to 1 to evaluate without it
};

// Of one pair of directions. The diffuse part is proportional to Bsdf::albedo.
struct BsdfValue {
    vec3 diffuse;   // f * |cos|
    vec3 specular;  // f * |cos|, everything that is not diffuse
    float pdf;      // with which bsdf_sample() finds wi; delta lobes aside
};

struct BsdfSample {
    vec3 wi;          // local
    vec3 weight;      // f * |cos| / density; 0: nothing was sampled, the path ends
    float pdf;        // 0 for a delta lobe
    bool delta;
    bool transmitted;  // wi is on the other side of the surface
    bool diffuse;      // the lobe that was chosen
    float roughness;   // GGX alpha of that lobe; diffuse: 1
};

vec3 to_local(Bsdf b, vec3 world) { return world * b.frame; }
vec3 to_world(Bsdf b, vec3 local) { return normalize(b.frame * local); }

// `geometric_normal` on the side of `wo_world`; `eta`: index of refraction behind the surface over that before it.
Bsdf make_bsdf(ShadedMaterial m, vec3 geometric_normal, vec3 wo_world, float eta)
{
    Bsdf b;
    b.frame = basis_around(m.shading_normal);
    b.geometric_normal = geometric_normal * b.frame;
    b.albedo = m.albedo;
    return b;
}

BsdfValue bsdf_evaluate(Bsdf b, vec3 wo, vec3 wi)
{
    BsdfValue v = BsdfValue(vec3(0.0), vec3(0.0), 0.0);
    if (dot(b.geometric_normal, wi) > 0.0) {
        v.diffuse = diffuse_eval(b.albedo, wo, wi) * max(wi.z, 0.0);
        v.pdf = diffuse_pdf(wi.z);
    }
    return v;
}

vec3 bsdf_eval(Bsdf b, vec3 wo, vec3 wi)
{
    const BsdfValue v = bsdf_evaluate(b, wo, wi);
    return v.diffuse + v.specular;
}

float bsdf_pdf(Bsdf b, vec3 wo, vec3 wi) { return bsdf_evaluate(b, wo, wi).pdf; }

// u: xy the direction, w the lobe; z is left to the caller (roulette).
BsdfSample bsdf_sample(Bsdf b, vec3 wo, vec4 u)
{
    const vec3 wi = sample_cosine_hemisphere(u.xy);
    const BsdfValue v = bsdf_evaluate(b, wo, wi);
    const vec3 weight = v.pdf > 0.0 ? (v.diffuse + v.specular) / v.pdf : vec3(0.0);
    return BsdfSample(wi, weight, v.pdf, false, false, true, 1.0);
}
