// A point of a path where light is scattered: on a surface, or in the fog.
#pragma once
#include "gbuffer/first_surface.glsl"
#ifdef FX_FOG
#include "media/scene_fog.glsl"
#endif

struct Vertex {
    vec3 position;
    float offset;           // of rays that leave it [m]
    vec3 geometric_normal;  // on the side the path came from; in fog of no meaning
    vec3 shading_normal;    // likewise; in fog zero
    vec3 wo;                // unit, back along the path
    Bsdf bsdf;
#ifdef FX_DIELECTRIC
    Interior before;  // what the path is inside of where it comes from
    Interior behind;  // and on the other side of the surface
#endif
#ifdef FX_FOG
    bool in_fog;
#endif
};

// Light that goes from one direction into another, in its two signals. The diffuse part lacks the albedo where
// Bsdf::albedo does.
struct Scattered {
    vec3 diffuse;
    vec3 specular;
    float pdf;  // of sampling the direction
};

#ifdef FX_DIELECTRIC
Vertex surface_vertex(Surface s, ShadedMaterial m, vec3 wo, Interior before)
{
    const Boundary boundary = boundary_at(before, m, s.material, s.front);
    const float eta = boundary.eta;
    Interior behind = before;
    cross_boundary(behind, m, s.material, s.front);
    if (!boundary.real)
        see_through(m);
#else
Vertex surface_vertex(Surface s, ShadedMaterial m, vec3 wo)
{
    const float eta = opaque_eta(m);
#endif
    Vertex v;
    v.position = s.position;
    v.offset = s.offset;
    v.geometric_normal = s.geometric_normal;
    v.shading_normal = m.shading_normal;
    v.wo = wo;
    v.bsdf = make_bsdf(m, s.geometric_normal, wo, eta);
#ifdef FX_DIELECTRIC
    v.before = before;
    v.behind = behind;
#endif
#ifdef FX_FOG
    v.in_fog = false;
#endif
    return v;
}

#ifdef FX_DIELECTRIC
// Fog fills what nothing else does.
bool in_the_open(Interior interior) { return interior.entered == uvec4(0u); }

// What a path is inside of that leaves the vertex to either side.
Interior inside_after(Vertex v, bool transmitted)
{
    Interior interior = v.before;
    if (transmitted)
        interior = v.behind;
    return interior;
}
#endif

#ifdef FX_FOG
// The vertex at distance t of the ray, made of any other.
Vertex fog_vertex(Vertex v, Ray ray, float t)
{
    v.position = ray.origin + t * ray.direction;
    v.offset = 0.0;
    v.shading_normal = vec3(0.0);
    v.wo = -ray.direction;
    v.geometric_normal = v.wo;
#ifdef FX_DIELECTRIC
    v.before = v.behind = outside_of_everything();
#endif
    v.in_fog = true;
    return v;
}
#endif

// What was sampled, in world space.
struct Bounce {
    vec3 wi;
    Scattered weight;  // value / density
    bool delta;
    bool transmitted;
    float roughness;  // GGX alpha of the lobe; diffuse: 1
};

Scattered scatter(Vertex v, vec3 wi)
{
    const BsdfValue value = bsdf_evaluate(v.bsdf, to_local(v.bsdf, v.wo), to_local(v.bsdf, wi));
    Scattered s = Scattered(value.diffuse, value.specular, value.pdf);
#ifdef FX_FOG
    const float phase = fog_phase(scene_fog(), -dot(v.wo, wi));
    if (v.in_fog)
        s = Scattered(vec3(phase), vec3(0.0), phase);
#endif
    return s;
}

Bounce sample_bounce(Vertex v, vec4 u)
{
    const vec3 wo = to_local(v.bsdf, v.wo);
    const BsdfSample b = bsdf_sample(v.bsdf, wo, u);
    Bounce bounce;
    bounce.wi = to_world(v.bsdf, b.wi);
    bounce.delta = b.delta;
    bounce.transmitted = b.transmitted;
    bounce.roughness = b.roughness;
    const bool usable = max_component(b.weight) > 0.0;
    const float scale = usable && !b.delta ? 1.0 / b.pdf : 0.0;
    bounce.weight = Scattered(b.value.diffuse * scale, b.value.specular * scale, b.pdf);
    if (b.delta)
        bounce.weight.specular = b.weight;
#ifdef FX_FOG
    const vec3 turned = sample_fog_phase(scene_fog(), -v.wo, u.xy);
    if (v.in_fog) {
        bounce.wi = turned;
        bounce.delta = bounce.transmitted = false;
        bounce.roughness = 1.0;
        bounce.weight = Scattered(vec3(1.0), vec3(0.0), fog_phase(scene_fog(), -dot(v.wo, turned)));
    }
#endif
    return bounce;
}

// Where a ray from the vertex along wi starts.
vec3 leave(Vertex v, vec3 wi) { return offset_origin(v.position, v.geometric_normal, v.offset, wi); }
