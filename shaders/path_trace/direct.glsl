// Light sampled at a vertex, and light met by chance, each weighted against the other by multiple importance sampling.
// Source: Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", chapter 9.
#pragma once
#include "path_trace/vertex.glsl"
#include "lib/counters.glsl"

#ifdef FX_LIGHTS
uniform int light_sampling;  // 0: light is met by chance only

// Radiance of one light sample that the vertex scatters back along the path, divided by its density and weighted
// against the chance that scattering finds the same light.
Scattered sample_direct(Vertex v, vec4 u)
{
    const LightSample light = sample_lights(v.position, v.shading_normal, u);
    const Scattered value = scatter(v, light.wi);
    note_cause(STAGE_LIGHT, kinds_in(light.radiance, value.diffuse + value.specular));
    note_cause(STAGE_LIGHT, kinds_in(vec3(light.pdf, value.pdf, 0.0)));
    const bool useful = light.pdf > 0.0 && value.pdf > 0.0 && max_component(light.radiance) > 0.0;
    // Both ends are offset off their surfaces, each by its own rounding error, and the ray runs between them.
    const vec3 from = leave(v, light.wi);
    const vec3 to = light.infinite ? from + light.wi : offset_origin(light.position, light.normal, light.offset, -light.wi);
    const vec3 way = to - from;
    const bool ahead = dot(way, light.wi) > 0.0;
    const float distance = light.infinite ? T_INFINITY : length(way);
    const Ray ray = Ray(from, light.infinite ? light.wi : normalize(way));
    const bool lit = useful && ahead && !any_hit(ray, useful && ahead ? distance : 0.0);
    const float weight = light.delta ? 1.0 : power_heuristic(light.pdf, value.pdf);
    vec3 arriving = light.radiance * (weight / light.pdf);
#ifdef FX_DIELECTRIC
    const Interior inside = inside_after(v, dot(v.geometric_normal, light.wi) < 0.0);
    const vec3 absorption = current_absorption(inside);
    if (max_component(absorption) > 0.0)
        arriving *= exp(-absorption * distance);
#endif
#ifdef FX_FOG
#ifdef FX_DIELECTRIC
    const bool in_air = in_the_open(inside);
#else
    const bool in_air = true;
#endif
    if (fog_present() && in_air) {
        const vec2 span = fog_span(scene_fog(), ray.origin, ray.direction, distance);
        arriving *= fog_transmittance(scene_fog(), span.y - span.x);
    }
#endif
    return Scattered(lit ? value.diffuse * arriving : vec3(0.0), lit ? value.specular * arriving : vec3(0.0), 0.0);
}
#endif

// Weight of light met by chance along `bounce`, whose light sampling has density pdf_light.
float chance_weight(Bounce bounce, float pdf_light)
{
    return bounce.delta ? 1.0 : power_heuristic(bounce.weight.pdf, pdf_light);
}

// Radiance of surface `s`, met from vertex v.
vec3 met_emission(Vertex v, Bounce bounce, Surface s, ShadedMaterial m)
{
#ifdef FX_LIGHTS
    const float pdf_light
        = light_pdf(max(s.light, 1u) - 1u, v.position, v.shading_normal, s.position, s.geometric_normal);
    if (light_sampling != 0 && s.light != 0u)
        return m.emission * chance_weight(bounce, pdf_light);
#endif
    return m.emission;
}

// Radiance from beyond everything.
vec3 met_environment(Bounce bounce)
{
    const vec3 radiance = environment_radiance(bounce.wi);
#ifdef FX_LIGHTS
    const float pdf_light = environment_pdf(bounce.wi);
    if (light_sampling != 0 && pdf_light > 0.0)
        return radiance * chance_weight(bounce, pdf_light);
#endif
    return radiance;
}
