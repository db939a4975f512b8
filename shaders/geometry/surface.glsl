// From a hit to a surface: position, normals, what it is; and rays that leave it without hitting it again.
#pragma once
#include "geometry/attributes.glsl"
#include "geometry/instances.glsl"
#include "geometry/traverse.glsl"
#include "lib/packing.glsl"
#include "lib/sampling.glsl"

struct Surface {
    vec3 position;          // world space [m], on the surface within `offset`
    vec3 prev_position;     // where this point of the surface was last frame [m]
    vec3 extent;            // largest coordinates of the primitive, in the space of its tree [m]
    float offset;           // how far a ray must start off the surface to be free of it [m]
    vec3 geometric_normal;  // unit, towards where the ray came from
    vec3 shading_normal;    // unit, interpolated, same side
    bool front;             // the ray met the side the geometry's own normal points to
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

// `precise`: equal vertices of last frame and this give equal bits, so that what rests has no motion.
vec3 interpolated_position(vec3 weights, vec3 v0, vec3 v1, vec3 v2)
{
    precise const vec3 position = weights.x * v0 + weights.y * v1 + weights.z * v2;
    return position;
}

#ifdef FX_TRIANGLES
void triangle_surface(Hit hit, Ray ray, inout Surface s)
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
    s.position = interpolated_position(weights, v0, v1, v2);
    // A sliver is met although single precision finds no area: it faces whoever looks.
    precise const vec3 across = cross(v1 - v0, v2 - v0);
    s.geometric_normal = normalize(dot(across, across) > 0.0 ? across : -ray.direction);
    s.extent = max(abs(v0), max(abs(v1), abs(v2)));
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
    s.extent = abs(sphere.xyz) + sphere.w;
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
    s.extent = abs(disk.xyz) + disk.w;
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

#ifdef FX_INSTANCES
// Roundings of coordinates, in units of 2^-24, on the way of a hit point into the world and of the next ray back:
// interpolating and testing again as above, in the object's space; the way out (4); the way in (5 and one for each
// matrix entry).
const float ROUNDINGS_IN_OBJECT = 16.0;
const float ROUNDINGS_OUT = 4.0;
const float ROUNDINGS_IN = 6.0;

// Takes a surface found in the space of instance `instance` to the world. `extent`: largest coordinates in the
// object's space.
void place_in_world(uint instance, inout Surface s)
{
    const Transform m = world_from_object(instance);
    const Transform inverse = object_from_world(instance);
    const uvec4 ids = instance_ids(instance);
    const vec2 scale = uintBitsToFloat(fetch_attribute(instances, instance_at(instance) + INSTANCE_SCALE).xy);
    const bool lit = ids.w != 0u && s.light != 0u;
    s.object = ids.y;
    s.material = ids.z;
    s.light = lit ? ids.w + s.light - 1u : 0u;
#ifdef FX_MOTION
    const Transform prev_m = load_transform(prev_instances, (int(instance) - 1) * PREV_INSTANCE_TEXELS);
    const vec3 moved_from = transform_point(prev_m, s.position);
#endif
    s.position = transform_point(m, s.position);
    s.prev_position = s.position;
#ifdef FX_MOTION
    if (textureSize(prev_instances) > 1)  // else nothing moves
        s.prev_position = moved_from;
#endif
    s.geometric_normal = normalize(transform_normal(inverse, s.geometric_normal));
    s.shading_normal = normalize(transform_normal(inverse, s.shading_normal));
    const vec3 linear_extent = vec3(dot(abs(m.x.xyz), s.extent), dot(abs(m.y.xyz), s.extent), dot(abs(m.z.xyz), s.extent));
    const vec3 world_extent = transform_extent(m, s.extent);
    const vec3 way_in = transform_extent(inverse, abs(s.position));
    const vec3 way_in_extent = vec3(dot(abs(m.x.xyz), way_in), dot(abs(m.y.xyz), way_in), dot(abs(m.z.xyz), way_in));
    s.offset = 5.9604645e-8
        * max_component(ROUNDINGS_IN_OBJECT * linear_extent + ROUNDINGS_OUT * world_extent + ROUNDINGS_IN * way_in_extent);
#ifdef FX_TEXTURES
    s.log2_uv_per_metre -= scale.x;
#endif
#ifdef FX_NORMAL_MAPS
    s.tangent = vec4(normalize(transform_direction(m, s.tangent.xyz)), s.tangent.w * scale.y);
#endif
}
#endif

#ifdef FX_DEFORMATION
// Where the same point of a triangle that deforms was last frame; `position` for any other.
vec3 previous_vertex_position(Hit hit, vec3 position)
{
    const uvec2 deforming = texelFetch(prev_vertices, 0).xy;
    const uint place = (hit.slot & BVH_FIRST_MASK) - deforming.x;  // wraps round for those before
    const bool deforms = (hit.slot & BVH_KIND_MASK) == BVH_TRIANGLES && place < deforming.y;
    const int at = deforms ? PREV_VERTEX_HEADER + int(place) * TRIANGLE_TEXELS : 0;
    const vec3 weights = corner_weights(hit.barycentric);
    const vec3 v0 = uintBitsToFloat(fetch_attribute(prev_vertices, at).xyz);
    const vec3 v1 = uintBitsToFloat(fetch_attribute(prev_vertices, at + 1).xyz);
    const vec3 v2 = uintBitsToFloat(fetch_attribute(prev_vertices, at + 2).xyz);
    const vec3 previous = interpolated_position(weights, v0, v1, v2);
    return deforms ? previous : position;
}
#endif

// A miss gives some surface, which the caller must not use: on SIMD hardware a branch would not be cheaper.
Surface surface_at(Hit hit, Ray ray)
{
    hit.slot = hit.slot == NO_HIT ? 0u : hit.slot;
    Ray local_ray = ray;
#ifdef FX_INSTANCES
    const bool placed = hit.instance != NO_INSTANCE;
    const Ray placed_ray = object_ray(hit.instance, ray);
    if (placed)
        local_ray = placed_ray;
#endif
    Surface s;
    s.position = s.extent = vec3(0.0);
    s.geometric_normal = s.shading_normal = vec3(0.0, 0.0, 1.0);
    s.object = s.material = s.light = 0u;
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
    triangle_surface(hit, local_ray, s);
#endif
#ifdef FX_SPHERES
    if ((hit.slot & BVH_KIND_MASK) == BVH_SPHERES)
        sphere_surface(hit, local_ray, s);
#endif
#ifdef FX_DISKS
    if ((hit.slot & BVH_KIND_MASK) == BVH_DISKS)
        disk_surface(hit, local_ray, s);
#endif
    s.offset = position_error(s.extent);
    s.prev_position = s.position;
#ifdef FX_DEFORMATION
    s.prev_position = previous_vertex_position(hit, s.position);
#endif
#ifdef FX_INSTANCES
    if (placed)
        place_in_world(hit.instance, s);
#endif
#ifdef FX_ALPHA
    s.material &= ~MATERIAL_HAS_HOLES;
#endif
    face_the_ray(ray, s);
    return s;
}

// A point just off the surface on the side `direction` leaves to.
// The offset follows from the coordinates' own rounding, so it scales with the scene: no absolute epsilon.
vec3 offset_origin(vec3 position, vec3 geometric_normal, float offset, vec3 direction)
{
    return position + geometric_normal * (dot(direction, geometric_normal) >= 0.0 ? offset : -offset);
}
