// Path tracing from the G-buffer's hit: what arrives at the first surface, split into signals by the lobe that turns it
// towards the eye.
//
//   in   in_hit          rgba32ui  the primary hit (geometry/hit_texel.glsl)
//        in_reflectance  rgba32f   what the specular signal is divided by
//   out  out_direct      rgba32f   diffuse light that met one surface between light and pixel, without its albedo
//        out_indirect    rgba32f   diffuse light that met more, likewise without the first surface's albedo
//        out_specular    rgba32f   light by the first surface's specular lobes, divided by its reflectance;
//                                  a: mean distance of what they show [m], 0: unknown
//        out_shown       rgba32ui  what they show, by a sample (svgf/signal.glsl): distance [m] as float bits, 0: unknown;
//                                  normal, octahedral; albedo, 8 bits a channel
//        out_scattered   rgba32f   light that the fog before the first surface scatters to the eye
//
// Many samples are traced in several dispatches (server/passes/path_trace.h): CONTINUES is defined for all but the
// first, which find the mean of the samples before theirs in in_direct, in_indirect, in_specular and in_scattered, and
// what these showed in in_shown.
//
// Each vertex samples a light and a direction of its BSDF or phase function and combines both by multiple importance
// sampling. Source: Veach 1997, chapters 8 to 10; Kajiya 1986, "The Rendering Equation".
#version 450
#include "lib/primary_ray.glsl"
#include "geometry/hit_texel.glsl"
#include "path_trace/direct.glsl"
#include "lib/loops.glsl"
#include "lib/unknown.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform usampler2D in_hit;
uniform writeonly image2D out_direct;
uniform writeonly image2D out_indirect;
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D in_reflectance;
uniform writeonly image2D out_specular;
uniform writeonly uimage2D out_shown;
#endif
#ifdef FX_FOG
uniform writeonly image2D out_scattered;
#endif
#ifdef CONTINUES
uniform sampler2D in_direct;
uniform sampler2D in_indirect;
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D in_specular;
uniform usampler2D in_shown;
#endif
#ifdef FX_FOG
uniform sampler2D in_scattered;
#endif
uniform int samples_before;
#else
const int samples_before = 0;
#endif

uniform int samples_per_pixel;  // of this dispatch
uniform int max_depth;       // segments from the camera, >= 1
uniform int roulette_depth;  // segments after which a path may be ended by chance

// What one path brings back to its first vertex.
struct Gathered {
    vec3 direct;
    vec3 indirect;
#ifdef FX_SPECULAR_SIGNAL
    vec3 specular;
    float distance;  // of what the specular lobes show, beyond mirrors in between too [m]; 0: not seen
    vec3 normal;     // of that
    vec3 albedo;
#endif
};

Gathered nothing_gathered()
{
    Gathered g;
    g.direct = g.indirect = vec3(0.0);
#ifdef FX_SPECULAR_SIGNAL
    g.specular = vec3(0.0);
    g.distance = 0.0;
    g.normal = g.albedo = vec3(0.0);
#endif
    return g;
}

// Whether a path was inside of more than it can keep.
bool crowded = false;

// Of what a ray brought back: the way, the normal, and where nothing was met the ray itself.
uint kinds_of_hit(Ray ray, Surface s, bool met, float way)
{
    return nonfinite_in(met ? way + dot(s.geometric_normal, ray.direction) : dot(ray.direction, ray.direction));
}

// A path from its first vertex on. `first_bounce` sets its random numbers apart from other paths of the sample;
// `cone` is the width of the pixel's cone there [m] and what it grows by a metre.
Gathered trace_path(Vertex v, uvec2 px, uint sample_index, uint first_bounce, vec2 cone)
{
    Gathered sum = nothing_gathered();
    precise vec3 throughput = vec3(1.0);  // of all vertices but the first
    vec3 first_diffuse = vec3(0.0);       // of the first, which splits what comes after into signals
#ifdef FX_SPECULAR_SIGNAL
    vec3 first_specular = vec3(0.0);
    float distance = 0.0;
    bool follows_mirrors = true;
#endif
    int segment = 2;
    bool alive = segment <= max_depth;
    do {
        const uint bounce_index = first_bounce + uint(segment) - 2u;
        const bool first = segment == 2;
        Scattered light = Scattered(vec3(0.0), vec3(0.0), 0.0);
#ifdef FX_LIGHTS
        cover_by(px, frame.seed, sample_index, bounce_index, SLOT_SHADOW_COVERAGE);
        if (light_sampling != 0)
            light = sample_direct(v, random4(px, frame.seed, sample_index, bounce_index, SLOT_LIGHT));
#endif
        const vec4 u = random4(px, frame.seed, sample_index, bounce_index, SLOT_BSDF);
        const Bounce bounce = sample_bounce(v, u);
        const vec3 weight = bounce.weight.diffuse + bounce.weight.specular;
        precise vec3 next = throughput;  // with this vertex, unless it is the first
        if (first) {
            first_diffuse = bounce.weight.diffuse;
            if (alive)
                sum.direct += light.diffuse;
#ifdef FX_SPECULAR_SIGNAL
            first_specular = bounce.weight.specular;
            if (alive)
                sum.specular += light.specular;
#endif
        } else {
            const vec3 arriving = throughput * (light.diffuse + light.specular);
            if (alive)
                sum.indirect += first_diffuse * arriving;
#ifdef FX_SPECULAR_SIGNAL
            if (alive)
                sum.specular += first_specular * arriving;
#endif
            next = throughput * weight;
        }
        note_cause(STAGE_THROUGHPUT, alive ? kinds_in(first ? weight : next, vec3(bounce.weight.pdf)) : 0u);
        const float survive = clamp(max_component(next), 0.05, 1.0);
        if (segment > roulette_depth) {
            alive = alive && u.z < survive;
            next /= survive;
        }
        throughput = next;

        alive = alive && max_component(weight) > 0.0 && max_component(throughput) > 0.0;
        const Ray ray = Ray(leave(v, bounce.wi), bounce.wi);
        cover_by(px, frame.seed, sample_index, bounce_index, SLOT_COVERAGE);
        const Hit hit = closest_hit(ray, alive ? T_INFINITY : 0.0);
        const bool met = hit.slot != NO_HIT;
        const Surface s = surface_at(hit, ray);
        const float way = length(s.position - ray.origin);
        note_cause(STAGE_HIT, alive ? kinds_of_hit(ray, s, met, way) : 0u);
        cone.y += 0.25 * bounce.roughness;  // a quarter of what the lobe covers is filtered, the rest is sampled
        cone.x += cone.y * way;
        const ShadedMaterial m = material_at(s, -ray.direction,
            TextureLookup(log2_cone_width(cone.x, s.geometric_normal, ray.direction), true,
                random4(px, frame.seed, sample_index, bounce_index, SLOT_TEXTURE).xyz));
#ifdef FX_DIELECTRIC
        const Interior inside = inside_after(v, bounce.transmitted);
        crowded = crowded || (alive && inside.overflows > 0u);
        const vec3 absorption = current_absorption(inside);
        if (max_component(absorption) > 0.0)
            throughput *= exp(-absorption * (met ? way : T_INFINITY));
        Vertex there = surface_vertex(s, m, -ray.direction, inside);
        const bool in_air = in_the_open(inside);
#else
        Vertex there = surface_vertex(s, m, -ray.direction);
        const bool in_air = true;
#endif
        vec3 found = met ? met_emission(v, bounce, s, m) : met_environment(bounce);
        bool goes_on = met && scatters(m);
#ifdef FX_FOG
        if (fog_present() && in_air) {
            const vec2 span = fog_span(scene_fog(), ray.origin, ray.direction, met ? way : T_INFINITY);
            const FogEvent event
                = sample_fog(scene_fog(), span.y - span.x, random4(px, frame.seed, sample_index, bounce_index, SLOT_FOG).xy);
            throughput *= event.weight;
            note_cause(STAGE_FOG, alive ? kinds_in(event.weight) : 0u);
            if (event.scattered) {
                there = fog_vertex(there, ray, span.x + event.way);
                found = vec3(0.0);
                goes_on = true;
            }
        }
#endif
        if (alive) {
            const vec3 arriving = throughput * found;
            if (first)
                sum.direct += first_diffuse * arriving;
            else
                sum.indirect += first_diffuse * arriving;
#ifdef FX_SPECULAR_SIGNAL
            sum.specular += first_specular * arriving;
            distance += met ? way : T_INFINITY;
            follows_mirrors = follows_mirrors && bounce.delta;
            if ((first || follows_mirrors) && max_component(first_specular) > 0.0) {
                sum.distance = distance;
                sum.normal = met ? m.shading_normal : -ray.direction;
                sum.albedo = met ? m.albedo : vec3(0.0);
            }
#endif
        }
        v = there;
        ++segment;
        alive = alive && goes_on && segment <= max_depth && noted == 0u;
    } while (alive);
    return sum;
}

// The mean of all samples so far from that of this dispatch's. Where one of both is not known, the other stands.
#ifdef CONTINUES
#define MEAN_WITH(before, mean) mean_with(texelFetch(before, px, 0), mean)
vec4 mean_with(vec4 before, vec4 mean)
{
    const vec4 both = before + (mean - before) * (float(samples_per_pixel) / float(samples_before + samples_per_pixel));
    return !is_light(before.rgb) ? mean : is_light(mean.rgb) ? both : before;
}
#else
#define MEAN_WITH(before, mean) (mean)
#endif

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const Hit hit = unpack_hit(texelFetch(in_hit, px, 0));
    const bool met = hit.slot != NO_HIT;
    const Ray ray = ray_of(primary_ray(px));
    const Surface s = surface_at(hit, ray);
    const ShadedMaterial m = first_material(s, ray);
    const float way = length(s.position - ray.origin);
#ifdef FX_DIELECTRIC
    Vertex first = surface_vertex(s, m, -ray.direction, around_camera());
#else
    Vertex first = surface_vertex(s, m, -ray.direction);
#endif
    first.bsdf.albedo = vec3(1.0);  // the composite multiplies it back
    const float footprint = frame.camera.pixel_footprint;

    note_cause(STAGE_HIT, kinds_of_hit(ray, s, met, way));
    Gathered sum = nothing_gathered();
    const bool lit = met && scatters(m) && max_depth > 1 && noted == 0u;
    int paths = lit ? samples_per_pixel : 0;
#ifdef FX_FOG
    // Two paths a sample, one from the surface and one from the fog before it; what the fog lacks is skipped.
    vec3 scattered = vec3(0.0);
    const vec2 span = fog_span(scene_fog(), ray.origin, ray.direction, met ? way : T_INFINITY);
    const bool foggy = fog_present() && span.y > span.x && max_depth > 1 && camera_in_the_open();
    const int surface_paths = paths;
    paths += foggy ? samples_per_pixel : 0;
#endif
#ifdef FX_SPECULAR_SIGNAL
    float distance_sum = 0.0;
    float distance_count = 0.0;
    uvec4 shown = uvec4(0u);
#endif
    int i = 0;
    while (i < paths) {
        uint sample_index = frame.first_sample + uint(samples_before + i);
        uint first_bounce = 0u;
        Vertex start = first;
        vec2 cone = vec2(footprint * way, footprint);
#ifdef FX_FOG
        const bool from_fog = i >= surface_paths;
        FogEvent event;
        if (from_fog) {
            sample_index = frame.first_sample + uint(samples_before + i - surface_paths);
            first_bounce = FOG_PATH_BOUNCE;
            event = sample_fog_within(scene_fog(),
                span.y - span.x, random4(uvec2(px), frame.seed, sample_index, first_bounce - 1u, SLOT_FOG).xy);
            start = fog_vertex(first, ray, span.x + event.way);
            cone.x = footprint * (span.x + event.way);
            note_cause(STAGE_FOG, kinds_in(event.weight));
        }
#endif
        const Gathered g = trace_path(start, uvec2(px), sample_index, first_bounce, cone);
#ifdef FX_FOG
        if (from_fog) {
            scattered += event.weight * (g.direct + g.indirect);
            ++i;
            continue;
        }
#endif
        sum.direct += g.direct;
        sum.indirect += g.indirect;
#ifdef FX_SPECULAR_SIGNAL
        sum.specular += g.specular;
        distance_sum += g.distance;
        distance_count += g.distance > 0.0 ? 1.0 : 0.0;
        if (g.distance > 0.0)
            shown = uvec4(floatBitsToUint(g.distance), pack_octahedral(g.normal), packUnorm4x8(vec4(g.albedo, 0.0)), 0u);
#endif
        ++i;
    }
    note(STAGE_HIT, loops_ran_out() ? IS_CLAMPED : 0u);
    const float weight = 1.0 / float(samples_per_pixel);
    const vec3 direct = sum.direct * weight;
    const vec3 indirect = sum.indirect * weight;
    note_cause(STAGE_RADIANCE, kinds_in(direct, indirect));
#ifdef FX_SPECULAR_SIGNAL
    const vec4 reflectance = texelFetch(in_reflectance, px, 0);
    const vec3 seen = sum.specular * weight * left_of_first_segment(met ? way : T_INFINITY);
    const vec3 specular = reflectance.a >= 0.0 ? seen / reflectance.rgb : vec3(0.0);
    note_cause(STAGE_RADIANCE, kinds_in(specular));
#endif
#ifdef FX_FOG
    scattered *= weight;
    note_cause(STAGE_FOG, kinds_in(scattered));
#endif
    imageStore(out_direct, px, MEAN_WITH(in_direct, vec4(light_if_known(direct), 0.0)));
    imageStore(out_indirect, px, MEAN_WITH(in_indirect, vec4(light_if_known(indirect), 0.0)));
#ifdef FX_SPECULAR_SIGNAL
    // Beyond ten thousand times the view distance nothing shifts any more.
    const float distance = distance_count > 0.0 ? min(distance_sum / distance_count, 1e4 * way) : 0.0;
    imageStore(out_specular, px, MEAN_WITH(in_specular, vec4(light_if_known(specular), distance)));
#ifdef CONTINUES
    shown = shown.x != 0u ? shown : texelFetch(in_shown, px, 0);
#endif
    imageStore(out_shown, px, shown);
#endif
#ifdef FX_FOG
    imageStore(out_scattered, px, MEAN_WITH(in_scattered, vec4(light_if_known(scattered), 0.0)));
#endif
    // The light stands: what found no place among a path's insides is taken for not there.
    note(STAGE_HIT, crowded ? IS_CLAMPED : 0u);
    tell_noted(px, STAGE_HIT);
}
