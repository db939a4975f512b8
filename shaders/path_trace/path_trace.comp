// Path tracing from the G-buffer's surface: direct and indirect diffuse light as separate signals.
//
//   in   in_surface    rgba32ui  depth (0: miss), gradients, shading normal
//        in_identity   rgba32ui  ids, geometric normal
//        in_position   rgba32f   world position, offset
//   out  out_direct    rgba32f   radiance that met one surface between light and pixel, without that surface's albedo
//        out_indirect  rgba32f   radiance that met more, likewise demodulated by the first surface's albedo
//
// Each vertex samples a light and a direction of the BSDF and combines both by multiple importance sampling.
// Source: Veach 1997, chapters 8 to 10; Kajiya 1986, "The Rendering Equation".
#version 450
#include "lib/frame.glsl"
#include "lib/random.glsl"
#include "geometry/surface.glsl"
#include "lights/lights.glsl"
#include "bsdf/diffuse.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform usampler2D in_surface;
uniform usampler2D in_identity;
uniform sampler2D in_position;
uniform writeonly image2D out_direct;
uniform writeonly image2D out_indirect;

uniform int samples_per_pixel;
uniform int max_depth;       // segments from the camera, >= 1
uniform int roulette_depth;  // segments after which a path may be ended by chance
#ifdef FX_LIGHTS
uniform int light_sampling;  // 0: light is met by chance only
#endif

struct Vertex {
    vec3 position;
    float offset;
    vec3 geometric_normal;
    vec3 shading_normal;
};

#ifdef FX_LIGHTS
// Incident radiance of one light sample times cosine over pi, divided by its density and weighted against the
// chance that the BSDF sample finds the same light.
vec3 sample_direct(Vertex v, vec4 u)
{
    const LightSample s = sample_lights(v.position, v.shading_normal, u);
    const float cos_surface = dot(v.shading_normal, s.wi);
    const bool above = dot(v.geometric_normal, s.wi) > 0.0;
    const float pdf_bsdf = diffuse_pdf(cos_surface);
    const bool useful = s.pdf > 0.0 && pdf_bsdf > 0.0 && above && max_component(s.radiance) > 0.0;
    // Both ends are offset off their surfaces, each by its own rounding error, and the ray runs between them.
    const vec3 from = offset_origin(v.position, v.geometric_normal, v.offset, s.wi);
    const vec3 to = s.infinite ? from + s.wi : offset_origin(s.position, s.normal, s.offset, -s.wi);
    const vec3 way = to - from;
    const float distance = length(way);
    const bool ahead = dot(way, s.wi) > 0.0;
    const float t_max = s.infinite ? T_INFINITY : distance;
    const bool blocked = any_hit(Ray(from, way / distance), useful && ahead ? t_max : 0.0);
    const float weight = s.delta ? 1.0 : power_heuristic(s.pdf, pdf_bsdf);
    return useful && !blocked ? s.radiance * (pdf_bsdf / s.pdf * weight) : vec3(0.0);
}
#endif

// Radiance met by a BSDF sample, weighted against light sampling.
vec3 weighted_emission(Vertex v, Material material, Surface s, float pdf_bsdf)
{
    const vec3 radiance = emitted(material, s.front);
#ifdef FX_LIGHTS
    const float pdf_light = light_pdf(
        max(s.light, 1u) - 1u, v.position, v.shading_normal, s.position, s.geometric_normal);
    if (light_sampling != 0 && s.light != 0u)
        return radiance * power_heuristic(pdf_bsdf, pdf_light);
#endif
    return radiance;
}

// One path; adds to the two signals.
void trace_path(Vertex v, uvec2 px, uint sample_index, inout vec3 direct, inout vec3 indirect)
{
    precise vec3 throughput = vec3(1.0);  // of all surfaces but the first
    int segment = 2;
    bool alive = segment <= max_depth;
    do {
        const uint bounce = uint(segment) - 2u;
        vec3 gathered = vec3(0.0);
#ifdef FX_LIGHTS
        if (light_sampling != 0)
            gathered = sample_direct(v, random4(px, frame.seed, sample_index, bounce, SLOT_LIGHT));
#endif
        const vec4 u = random4(px, frame.seed, sample_index, bounce, SLOT_BSDF);
        const vec3 local = sample_cosine_hemisphere(u.xy);
        const vec3 wi = normalize(basis_around(v.shading_normal) * local);
        const bool leaves = alive && dot(v.geometric_normal, wi) > 0.0;
        const Ray ray = Ray(offset_origin(v.position, v.geometric_normal, v.offset, wi), wi);
        const Hit hit = closest_hit(ray, leaves ? T_INFINITY : 0.0);
        const bool met = hit.slot != NO_HIT;
        const Surface s = surface_at(hit, ray);
        const Material material = load_material(s.material);
        if (met)
            gathered += weighted_emission(v, material, s, diffuse_pdf(local.z));
#ifdef FX_BACKGROUND
        else if (leaves)
            gathered += environment_radiance(wi);
#endif
        if (alive) {
            if (segment == 2)
                direct += gathered;
            else
                indirect += throughput * gathered;
        }

        throughput *= material.albedo;
        const float survive = clamp(max_component(throughput), 0.05, 1.0);
        if (segment >= roulette_depth) {
            alive = alive && u.z < survive;
            throughput /= survive;
        }
        v = Vertex(s.position, s.offset, s.geometric_normal, s.shading_normal);
        ++segment;
        alive = alive && met && segment <= max_depth && max_component(throughput) > 0.0;
    } while (alive);
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const uvec4 surface = texelFetch(in_surface, px, 0);
    const vec4 position = texelFetch(in_position, px, 0);
    const Vertex first = Vertex(position.xyz, position.w, unpack_octahedral(texelFetch(in_identity, px, 0).z),
        unpack_octahedral(surface.w));
    vec3 direct = vec3(0.0);
    vec3 indirect = vec3(0.0);
    const bool met = uintBitsToFloat(surface.x) > 0.0;
    int i = met && max_depth > 1 ? 0 : samples_per_pixel;
    while (i < samples_per_pixel) {
        const uint sample_index = frame.first_sample + uint(i);
        trace_path(first, uvec2(px), sample_index, direct, indirect);
        ++i;
    }
    const float weight = 1.0 / float(samples_per_pixel);
    imageStore(out_direct, px, vec4(counted_finite(direct * weight), 0.0));
    imageStore(out_indirect, px, vec4(counted_finite(indirect * weight), 0.0));
}
