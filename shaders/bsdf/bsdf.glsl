// How a surface scatters light: one set of functions over all lobes that are compiled.
//
// Directions are unit vectors in the local frame of the shading normal (z), both pointing away from the surface:
//   wo  towards the viewer, on the side of the geometric normal      wi  towards the light
// Get one with make_bsdf() for a vertex and its wo; its lobes' weights hold for that wo alone.
//
// *Values include the cosine*: bsdf_eval() is f * |cos|. Densities are per solid angle [1/sr]. Delta lobes are in
// bsdf_sample() only. Transmitted radiance is basic radiance, L / n^2: every interface is then lossless by itself, and
// what is seen from outside is the same.
//
// Layers from the top: clearcoat; a dielectric or conducting surface; below it a diffuse layer or the inside. Each gets
// what the ones above let through, by directional albedo, so white layers lose nothing.
//
// A shading normal is not the surface's: a lobe around it reaches below the geometric surface. Those directions are
// mirrored at the geometric surface, in samples, values and densities alike, so neither light nor energy leaks.
// Compare Schüssler et al. 2017, "Microfacet-based Normal Mapping for Robust Monte Carlo Path Tracing", whose
// mirror-like tangent facets do the same to what leaves the mapped facet downwards.
#pragma once
#include "bsdf/clearcoat.glsl"
#include "bsdf/diffuse.glsl"
#include "bsdf/interface.glsl"
#include "bsdf/reflection.glsl"

#if defined(FX_SHADING_NORMALS) || defined(FX_NORMAL_MAPS)
#define SHADING_NORMAL_DIFFERS
#endif

struct Bsdf {
    mat3 frame;    // world from local
    vec3 albedo;   // of the diffuse lobe; set it to 1 to evaluate without it
    vec3 diffuse;  // weight of the diffuse lobe: what the layers above let through
    float p_diffuse;  // probability of choosing each lobe; all 0: nothing is scattered
#ifdef SHADING_NORMAL_DIFFERS
    vec3 geometric_normal;  // local, unit, on the viewer's side
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR)
    Reflection reflection;
    float p_reflection;
#endif
#ifdef FX_DIELECTRIC
    Interface surface;
    float p_interface;
#endif
#ifdef FX_CLEARCOAT
    Clearcoat coat;
    float p_coat;
#endif
};

// Of one pair of directions. The diffuse part is proportional to Bsdf::albedo.
struct BsdfValue {
    vec3 diffuse;   // f * |cos|
    vec3 specular;  // f * |cos|, everything that is not diffuse
    float pdf;      // with which bsdf_sample() finds wi; delta lobes aside
};

struct BsdfSample {
    vec3 wi;           // local
    vec3 weight;       // f * |cos| / density; 0: nothing was sampled, the path ends
    float pdf;         // 0 for a delta lobe
    bool delta;
    bool transmitted;  // wi is on the other side of the surface
    bool diffuse;      // the lobe that was chosen
    float roughness;   // GGX alpha of that lobe; diffuse: 1
    BsdfValue value;   // at wi, without delta lobes
};

vec3 to_local(Bsdf b, vec3 world)
{
    precise const vec3 local = world * b.frame;
    return local;
}

vec3 to_world(Bsdf b, vec3 local)
{
    precise const vec3 world = b.frame * local;
    return normalize(world);
}

// Exactly 1 where nothing else is there: a program without the other lobes has no division either.
float share(float weight, float total) { return weight == total ? (total > 0.0 ? 1.0 : 0.0) : weight / total; }

// `geometric_normal` on the side of `wo_world`; `eta`: index of refraction behind the surface over that before it.
Bsdf make_bsdf(ShadedMaterial m, vec3 geometric_normal, vec3 wo_world, float eta)
{
    Bsdf b;
    b.frame = basis_around(m.shading_normal);
    const vec3 wo = above_horizon(to_local(b, wo_world));
#ifdef SHADING_NORMAL_DIFFERS
    b.geometric_normal = m.shading_normal == geometric_normal ? vec3(0.0, 0.0, 1.0) : to_local(b, geometric_normal);
#endif
    b.albedo = m.albedo;
    b.diffuse = vec3(1.0);
    precise float through = 1.0;  // the coat
#ifdef FX_UNLIT
    through = m.unlit ? 0.0 : 1.0;
#endif
#ifdef FX_CLEARCOAT
    b.coat = make_clearcoat(m, to_local(b, m.clearcoat_normal), wo);
    const float w_coat = b.coat.albedo;
    through = w_coat > 0.0 ? 1.0 - w_coat : through;
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    precise float opaque = m.metallic > 0.0 ? 1.0 - m.metallic : 1.0;
#ifdef FX_DIELECTRIC
    precise const float part = opaque * m.transmission;
    opaque = m.transmission > 0.0 ? opaque - part : opaque;
    b.surface = make_interface(m, wo.z, eta, part * through);
    const float w_interface = b.surface.albedo;
#endif
    b.diffuse = vec3(opaque);
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR)
    b.reflection = make_reflection(m, wo.z, eta, opaque, b.diffuse);
    b.reflection.r0 *= through;
    b.reflection.r90 *= through;
    const float w_reflection = average(b.reflection.albedo) * through;
#endif
#endif
    b.diffuse *= through;
    const float w_diffuse = average(b.albedo * b.diffuse);
    precise float total = w_diffuse;
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR)
    total += w_reflection;
#endif
#ifdef FX_DIELECTRIC
    total += w_interface;
#endif
#ifdef FX_CLEARCOAT
    total += w_coat;
    b.p_coat = share(w_coat, total);
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR)
    b.p_reflection = share(w_reflection, total);
#endif
#ifdef FX_DIELECTRIC
    b.p_interface = share(w_interface, total);
#endif
    b.p_diffuse = share(w_diffuse, total);
    return b;
}

// Adds the lobes at `wi` which reach the side of the surface that is looked at.
void add_lobes(Bsdf b, vec3 wo, vec3 wi, bool above, inout BsdfValue v)
{
    precise vec3 diffuse = v.diffuse;
    precise vec3 specular = v.specular;
    precise float pdf = v.pdf;
    if (above) {
        diffuse += b.diffuse * diffuse_eval(b.albedo, wo, wi) * max(wi.z, 0.0);
        pdf += b.p_diffuse * diffuse_pdf(wi.z);
#ifdef FX_ROUGH_REFLECTION
        const LobeValue base = evaluate(b.reflection, wo, wi);
        specular += base.value;
        pdf += b.p_reflection * base.pdf;
#endif
#ifdef FX_CLEARCOAT
        const LobeValue coat = evaluate(b.coat, wo, wi);
        specular += coat.value;
        pdf += b.p_coat * coat.pdf;
#endif
    }
#ifdef FX_ROUGH_DIELECTRIC
    if (above == (wi.z > 0.0)) {
        const LobeValue surface = evaluate(b.surface, wo, wi);
        specular += surface.value;
        pdf += b.p_interface * surface.pdf;
    }
#endif
    v = BsdfValue(diffuse, specular, pdf);
}

#ifdef SHADING_NORMAL_DIFFERS
// Whether a lobe on one side of the geometric surface has values at `folded`, which is on the other.
bool reaches_across(Bsdf b, vec3 folded, bool above)
{
    bool reaches = (folded.z > 0.0) == above && folded.z != 0.0;
#ifdef FX_CLEARCOAT
    reaches = reaches || (above && dot(b.coat.frame[2], folded) > 0.0);
#endif
    return reaches;
}
#endif

BsdfValue bsdf_evaluate(Bsdf b, vec3 viewer, vec3 wi)
{
    const vec3 wo = above_horizon(viewer);
    BsdfValue v = BsdfValue(vec3(0.0), vec3(0.0), 0.0);
#ifdef SHADING_NORMAL_DIFFERS
    precise const float height = dot(b.geometric_normal, wi);
    precise const vec3 folded = wi - 2.0 * height * b.geometric_normal;
    const bool above = height > 0.0;
    // The second time round for what would have gone to the other side, which few directions have. A loop, because
    // llvmpipe would run a branch for every lane.
    vec3 direction = wi;
    bool more = reaches_across(b, folded, above);
    int turn = 0;
    do {
        add_lobes(b, wo, direction, above, v);
        direction = folded;
    } while (more && ++turn < 2);
#else
    add_lobes(b, wo, wi, wi.z > 0.0, v);
#endif
    return v;
}

vec3 bsdf_eval(Bsdf b, vec3 wo, vec3 wi)
{
    const BsdfValue v = bsdf_evaluate(b, wo, wi);
    return v.diffuse + v.specular;
}

float bsdf_pdf(Bsdf b, vec3 wo, vec3 wi) { return bsdf_evaluate(b, wo, wi).pdf; }

// Chooses a lobe, which takes the next part of [0, 1) above `start`.
bool chosen(float u, float p, inout float start)
{
    const bool taken = u >= start && u < start + p;
    start += p;
    return taken;
}

// u: xy the direction, w the lobe; z is left to the caller (roulette).
BsdfSample bsdf_sample(Bsdf b, vec3 viewer, vec4 u)
{
    const vec3 wo = above_horizon(viewer);
    precise vec3 wi = sample_cosine_hemisphere(u.xy);
    precise vec3 weight = vec3(0.0);  // of a delta lobe
    const BsdfValue none = BsdfValue(vec3(0.0), vec3(0.0), 0.0);
    BsdfSample s = BsdfSample(wi, vec3(0.0), 0.0, false, false, true, 1.0, none);
    // The diffuse lobe comes last, and takes what rounding leaves.
    precise float start = 0.0;
    bool lost = false;  // a facet sends the light into the surface
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR)
    const vec3 base = sample_direction(b.reflection, wo, u.xy);
    if (chosen(u.w, b.p_reflection, start)) {
        wi = base;
        weight = reflectance(b.reflection, wo.z) / b.p_reflection;
        s = BsdfSample(wi, vec3(0.0), 0.0, b.reflection.alpha == 0.0, false, false, b.reflection.alpha, none);
        lost = !(wi.z > 0.0);
    }
#endif
#ifdef FX_CLEARCOAT
    const vec3 coat = sample_direction(b.coat, wo, u.xy);
    if (chosen(u.w, b.p_coat, start)) {
        wi = coat;
        weight = vec3(reflectance(b.coat, (above_horizon(wo * b.coat.frame)).z) / b.p_coat);
        s = BsdfSample(wi, vec3(0.0), 0.0, b.coat.alpha == 0.0, false, false, b.coat.alpha, none);
        lost = !(dot(b.coat.frame[2], wi) > 0.0);
    }
#endif
#ifdef FX_DIELECTRIC
    const float rest = b.p_interface > 0.0 ? clamp((u.w - start) / b.p_interface, 0.0, 0.99999994) : 0.0;
    const InterfaceSample surface = sample_interface(b.surface, wo, vec3(u.xy, rest));
    if (chosen(u.w, b.p_interface, start)) {
        wi = surface.wi;
        weight = surface.weight / b.p_interface;
        s = BsdfSample(wi, vec3(0.0), 0.0, b.surface.alpha == 0.0, surface.transmitted, false, b.surface.alpha, none);
        lost = (wi.z > 0.0) == s.transmitted;
    }
#endif
#ifdef SHADING_NORMAL_DIFFERS
    const float height = dot(b.geometric_normal, wi);
    if (!lost && (height > 0.0) == s.transmitted)
        wi -= 2.0 * height * b.geometric_normal;
#endif
    const BsdfValue v = bsdf_evaluate(b, wo, wi);
    s.wi = wi;
    s.value = v;
    if (!s.delta) {
        s.pdf = lost ? 0.0 : v.pdf;
        weight = s.pdf > 0.0 ? (v.diffuse + v.specular) / s.pdf : vec3(0.0);
    }
    s.weight = weight;
    return s;
}
