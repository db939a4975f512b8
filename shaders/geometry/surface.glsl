// From a hit to a surface: position, normals, what it is; and rays that leave it without hitting it again.
#pragma once
#include "geometry/attributes.glsl"
#include "geometry/traverse.glsl"
#include "lib/packing.glsl"
#include "lib/sampling.glsl"

struct Surface {
    vec3 position;          // world space [m], on the surface within `offset`
    vec3 prev_position;     // where this point of the surface was last frame [m]
    float offset;           // how far a ray must start off the surface to be free of it [m]
    vec3 geometric_normal;  // unit, towards where the ray came from
    vec3 shading_normal;    // unit, interpolated, same side
    bool front;             // the ray met the side the geometry's own normal points to
    uint primitive;         // unlike any other's
    uint object;
    uint material;
    uint light;  // index + 1, 0: none
#ifdef FX_TEXTURES
    vec2 uv[2];
    vec2 log2_uv_per_metre;  // of either set: log2 of sqrt(area in uv / area in the world)
#endif
#ifdef FX_NORMAL_MAPS
    vec4 tangent;  // xyz unit, towards growing u; bitangent = w * cross(shading normal of the front side, tangent)
#endif
#ifdef FX_VERTEX_COLORS
    vec4 color;  // linear, multiplies albedo and opacity
#endif
};

// Rounding of a coordinate that a hit point, and the next intersection test from it, may be off by, relative to the
// largest coordinate of the primitive: a hit point interpolates three vertices (7 roundings, Pharr et al. 2023,
// section 6.8.5), the next test translates, shears and weighs them again (9). Along the normal alone it would be less
// where the normal's coordinates are small, but the test's own error is not: it mixes all three axes.
const float POSITION_ULPS = 16.0 * 5.9604645e-8;

// The offset for a primitive whose coordinates are at most `extent` in magnitude.
float position_error(vec3 extent) { return POSITION_ULPS * max_component(extent); }

#ifdef FX_TRIANGLES
void triangle_surface(Hit hit, inout Surface s)
{
    const int place = int(hit.slot & BVH_FIRST_MASK);
    const uvec4 a = texelFetch(triangles, place * TRIANGLE_TEXELS);
    const uvec4 b = texelFetch(triangles, place * TRIANGLE_TEXELS + 1);
    const uvec4 c = texelFetch(triangles, place * TRIANGLE_TEXELS + 2);
    const vec3 v0 = uintBitsToFloat(a.xyz);
    const vec3 v1 = uintBitsToFloat(b.xyz);
    const vec3 v2 = uintBitsToFloat(c.xyz);
    const vec3 weights = corner_weights(hit.barycentric);
    s.object = a.w;
    s.material = b.w;
    s.light = c.w;
    s.position = weights.x * v0 + weights.y * v1 + weights.z * v2;
    s.geometric_normal = normalize(cross(v1 - v0, v2 - v0));
    s.offset = position_error(max(abs(v0), max(abs(v1), abs(v2))));
    s.shading_normal = s.geometric_normal;
#ifdef FX_SHADING_NORMALS
    s.shading_normal = interpolated_normal(place, weights, s.geometric_normal);
#endif
#ifdef FX_TEXTURES
    interpolated_uvs(place, weights, s.uv, s.log2_uv_per_metre);
#endif
#ifdef FX_NORMAL_MAPS
    s.tangent = interpolated_tangent(place, weights);
#endif
#ifdef FX_VERTEX_COLORS
    s.color = interpolated_color(place, weights);
#endif
}
#endif

#ifdef FX_SPHERES
void sphere_surface(Hit hit, Ray ray, inout Surface s)
{
    const int at = int(hit.slot & BVH_FIRST_MASK) * SPHERE_TEXELS;
    const vec4 sphere = uintBitsToFloat(texelFetch(spheres, at));
    const uvec4 ids = texelFetch(spheres, at + 1);
    const vec3 normal = normalize(ray.origin + hit.t * ray.direction - sphere.xyz);
    s.object = ids.x;
    s.material = ids.y;
    s.light = ids.z;
    s.geometric_normal = s.shading_normal = normal;
    s.position = sphere.xyz + sphere.w * normal;
    s.offset = position_error(abs(sphere.xyz) + sphere.w);
#ifdef FX_TEXTURES
    s.uv[0] = s.uv[1] = longitude_latitude(normal);
    s.log2_uv_per_metre = vec2(-0.5 * log2(4.0 * PI * sphere.w * sphere.w));
#endif
#ifdef FX_NORMAL_MAPS
    s.tangent = vec4(east(normal), 1.0);
#endif
#ifdef FX_VERTEX_COLORS
    s.color = vec4(1.0);
#endif
}
#endif

#ifdef FX_DISKS
void disk_surface(Hit hit, Ray ray, inout Surface s)
{
    const int at = int(hit.slot & BVH_FIRST_MASK) * DISK_TEXELS;
    const vec4 disk = uintBitsToFloat(texelFetch(disks, at));
    const vec3 normal = uintBitsToFloat(texelFetch(disks, at + 1).xyz);
    const uvec4 ids = texelFetch(disks, at + 2);
    const vec3 from_center = ray.origin + hit.t * ray.direction - disk.xyz;
    s.object = ids.x;
    s.material = ids.y;
    s.light = ids.z;
    s.geometric_normal = s.shading_normal = normal;
    s.position = disk.xyz + (from_center - dot(from_center, normal) * normal);
    s.offset = position_error(abs(disk.xyz) + disk.w);
#ifdef FX_TEXTURES
    s.uv[0] = s.uv[1] = vec2(0.0);
    s.log2_uv_per_metre = vec2(-30.0);  // one texel all over
#endif
#ifdef FX_NORMAL_MAPS
    s.tangent = vec4(basis_around(normal)[0], 1.0);
#endif
#ifdef FX_VERTEX_COLORS
    s.color = vec4(1.0);
#endif
}
#endif

// Turns the normals to the side the ray came from.
void face_the_ray(Ray ray, inout Surface s)
{
    s.front = dot(s.geometric_normal, ray.direction) < 0.0;
    s.geometric_normal = s.front ? s.geometric_normal : -s.geometric_normal;
    const vec3 smooth_normal = dot(s.shading_normal, s.geometric_normal) >= 0.0 ? s.shading_normal : -s.shading_normal;
    // An interpolated normal that faces away from the viewer would turn the surface black.
    s.shading_normal = dot(smooth_normal, ray.direction) < 0.0 ? smooth_normal : s.geometric_normal;
}

// A miss gives some surface, which the caller must not use: on SIMD hardware a branch would not be cheaper.
Surface surface_at(Hit hit, Ray ray)
{
    hit.slot = hit.slot == NO_HIT ? 0u : hit.slot;
    Surface s;
    s.position = vec3(0.0);
    s.offset = 0.0;
    s.geometric_normal = s.shading_normal = vec3(0.0, 0.0, 1.0);
    s.object = s.material = s.light = 0u;
    s.primitive = hit.slot;
#ifdef FX_TEXTURES
    s.uv[0] = s.uv[1] = s.log2_uv_per_metre = vec2(0.0);
#endif
#ifdef FX_NORMAL_MAPS
    s.tangent = vec4(1.0, 0.0, 0.0, 1.0);
#endif
#ifdef FX_VERTEX_COLORS
    s.color = vec4(1.0);
#endif
#ifdef FX_TRIANGLES
    triangle_surface(hit, s);
#endif
#ifdef FX_SPHERES
    if ((hit.slot & BVH_KIND_MASK) == BVH_SPHERES)
        sphere_surface(hit, ray, s);
#endif
#ifdef FX_DISKS
    if ((hit.slot & BVH_KIND_MASK) == BVH_DISKS)
        disk_surface(hit, ray, s);
#endif
    s.prev_position = s.position;
    face_the_ray(ray, s);
    return s;
}

// A point just off the surface on the side `direction` leaves to.
// The offset follows from the coordinates' own rounding, so it scales with the scene: no absolute epsilon.
vec3 offset_origin(vec3 position, vec3 geometric_normal, float offset, vec3 direction)
{
    return position + geometric_normal * (dot(direction, geometric_normal) >= 0.0 ? offset : -offset);
}
