// G-buffer: what the ray through each pixel meets first.
//
//   out  out_hit       rgba32ui  the hit (geometry/hit_texel.glsl)
//        out_surface   rgba32ui  view depth [m] and its change per pixel along x and y, as float bits; shading normal
//                                (octahedral). Depth 0 marks a miss.
//        out_identity  rgba32ui  object id, material id, geometric normal (octahedral), 1 on a hit
//        out_position  rgba32f   world position [m], counted from the scene's origin; a: 1 where there is a surface
//        out_albedo    rgba32f   diffuse reflectance, times what is left of light on its way through the camera's medium
//        out_emission  rgba32f   radiance that bypasses the filter: emitters seen directly, what is unlit, environment;
//                                likewise
//        out_motion    rgba32f   where the surface was: previous minus current pixel (xy) [px], previous minus
//                                current view depth (z) [m], 1 if it was ahead of the previous camera (w)
//        out_reflectance  rgba32f  what the specular signal is divided by; GGX alpha, negative: nothing specular
//        out_fog_way      r32f     way through fog before the surface [m]
#version 450
#include "lib/primary_ray.glsl"
#include "geometry/hit_texel.glsl"
#include "gbuffer/first_surface.glsl"
#include "lib/loops.glsl"
#include "lib/unknown.glsl"
#ifdef FX_SPECULAR_SIGNAL
#include "gbuffer/reflectance.glsl"
#endif
#ifdef FX_FOG
#include "media/scene_fog.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

uniform writeonly uimage2D out_hit;
uniform writeonly uimage2D out_surface;
uniform writeonly uimage2D out_identity;
uniform writeonly image2D out_position;
uniform writeonly image2D out_albedo;
uniform writeonly image2D out_emission;
uniform writeonly image2D out_motion;
#ifdef FX_SPECULAR_SIGNAL
uniform writeonly image2D out_reflectance;
#endif
#ifdef FX_FOG
uniform writeonly image2D out_fog_way;
#endif

// View depth and its screen derivatives: the tangent plane's depth at pixel p is n.(X - C) / n.d(p).
vec3 depth_and_gradient(vec3 direction, vec3 position, vec3 normal)
{
    const float depth = dot(position - frame.camera.position, frame.camera.forward);
    const float n_d = dot(normal, direction);
    const vec3 d_dx = frame.camera.right * (2.0 / float(frame.extent.x));
    const vec3 d_dy = -frame.camera.up * (2.0 / float(frame.extent.y));
    const vec2 gradient = -depth * vec2(dot(normal, d_dx), dot(normal, d_dy)) / n_d;
    // Seen edge-on the plane's depth changes without bound within a pixel: a thousandfold is as good as infinite.
    const vec2 bound = vec2(1e3 * depth);
    return vec3(depth, n_d != 0.0 ? clamp(gradient, -bound, bound) : bound);
}

// Both projections run the same arithmetic, so a camera at rest gives exactly zero.
vec4 motion_of(vec3 position, vec3 prev_position)
{
    const vec3 now = camera_project(frame.camera, position);
    const vec3 before = camera_project(frame.prev_camera, prev_position);
    return before.z > 0.0 ? vec4(before - now, 1.0) : vec4(0.0);
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    const PrimaryRay primary = primary_ray(px);
    const Ray ray = ray_of(primary);
    cover_by(uvec2(px), frame.seed, frame.first_sample, PRIMARY_BOUNCE, SLOT_COVERAGE);
    const Hit hit = closest_hit(ray, T_INFINITY);
    const bool met = hit.slot != NO_HIT;
    const Surface s = surface_at(hit, ray);
    const ShadedMaterial m = first_material(s, ray);
    const vec3 depth = depth_and_gradient(primary.direction, s.position, s.geometric_normal);
    const float way = met ? length(s.position - ray.origin) : T_INFINITY;
    const vec3 left = left_of_first_segment(way);
    const vec4 motion = met ? motion_of(s.position, s.prev_position) : vec4(0.0);
    const vec3 albedo = left * (met ? diffuse_albedo(m, s, ray) : vec3(0.0));
    const vec3 emission = left * (met ? m.emission : environment_radiance(ray.direction));
    note(STAGE_PRIMARY_RAY, nonfinite_in(dot(ray.origin + ray.direction, vec3(1.0))));
    note_cause(STAGE_GBUFFER, nonfinite_in(met ? dot(depth + s.position, vec3(1.0)) : 0.0));
    note_cause(STAGE_GBUFFER, kinds_in(albedo, emission));
    note(STAGE_GBUFFER, loops_ran_out() ? IS_CLAMPED : 0u);
#ifdef FX_SPECULAR_SIGNAL
    const vec4 specular = met ? reflectance(m, -ray.direction) : vec4(0.0, 0.0, 0.0, -1.0);
    note_cause(STAGE_GBUFFER, kinds_in(specular.rgb));
#endif

    imageStore(out_hit, px, pack_hit(hit));
    imageStore(out_surface, px, met ? uvec4(floatBitsToUint(depth), pack_octahedral(m.shading_normal)) : uvec4(0u));
    imageStore(out_identity, px,
        met ? uvec4(s.object, s.material, pack_octahedral(s.geometric_normal), 1u) : uvec4(0u));
    imageStore(out_position, px, met ? vec4(s.position, 1.0) : vec4(0.0));
    imageStore(out_albedo, px, vec4(noted == 0u ? albedo : vec3(0.0), met ? 1.0 : 0.0));
    imageStore(out_emission, px, vec4(light_if_known(emission), 1.0));
    imageStore(out_motion, px, motion);
#ifdef FX_SPECULAR_SIGNAL
    imageStore(out_reflectance, px, specular);
#endif
#ifdef FX_FOG
    const vec2 span = fog_span(scene_fog(), ray.origin, ray.direction, way);
    imageStore(out_fog_way, px, vec4(camera_in_the_open() ? span.y - span.x : 0.0));
#endif
    note_cause(STAGE_GBUFFER, nonfinite_in(dot(motion, vec4(1.0))));
    tell_noted(px, STAGE_PRIMARY_RAY);
}
