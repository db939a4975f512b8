// From a hit to a surface: position, normals, what it is; and rays that leave it without hitting it again.
#pragma once
#include "geometry/traverse.glsl"
#include "lib/packing.glsl"

struct Surface {
    vec3 position;          // world space [m], on the surface within `offset`
    float offset;           // how far a ray must start off the surface to be free of it [m]
    vec3 geometric_normal;  // unit, towards where the ray came from
    vec3 shading_normal;    // unit, same side
    bool front;             // the ray met the side the geometry's own normal points to
    uint primitive;
};

// Rounding of a coordinate that a hit point, and the next intersection test from it, may be off by, relative to the
// largest coordinate of the primitive: a hit point interpolates three vertices (7 roundings, Pharr et al. 2023,
// section 6.8.5), the next test translates, shears and weighs them again (9). Along the normal alone it would be less
// where the normal's coordinates are small, but the test's own error is not: it mixes all three axes.
const float POSITION_ULPS = 16.0 * 5.9604645e-8;

// The offset for a primitive whose coordinates are at most `extent` in magnitude.
float position_error(vec3 extent) { return POSITION_ULPS * max_component(extent); }

#ifdef FX_TRIANGLES
void triangle_surface(Hit hit, inout Surface s, out vec3 smooth_normal)
{
    const int at = int(hit.slot & BVH_FIRST_MASK) * TRIANGLE_TEXELS;
    const uvec4 texel = texelFetch(triangles, at);
    const vec3 v0 = uintBitsToFloat(texel.xyz);
    const vec3 v1 = uintBitsToFloat(texelFetch(triangles, at + 1).xyz);
    const vec3 v2 = uintBitsToFloat(texelFetch(triangles, at + 2).xyz);
    const vec2 b = hit.barycentric;
    s.primitive = texel.w;
    s.position = (1.0 - b.x - b.y) * v0 + b.x * v1 + b.y * v2;
    s.geometric_normal = normalize(cross(v1 - v0, v2 - v0));
    s.offset = position_error(max(abs(v0), max(abs(v1), abs(v2))));
    smooth_normal = s.geometric_normal;
#ifdef FX_SHADING_NORMALS
    const uvec4 normals = texelFetch(primitives, int(s.primitive) * PRIMITIVE_TEXELS + 1);
    if (load_primitive(s.primitive).smooth_normals)
        smooth_normal = normalize((1.0 - b.x - b.y) * unpack_octahedral(normals.x)
            + b.x * unpack_octahedral(normals.y) + b.y * unpack_octahedral(normals.z));
#endif
}
#endif

#ifdef FX_SPHERES
void sphere_surface(Hit hit, Ray ray, inout Surface s)
{
    const int at = int(hit.slot & BVH_FIRST_MASK) * SPHERE_TEXELS;
    const vec4 sphere = uintBitsToFloat(texelFetch(spheres, at));
    s.primitive = texelFetch(spheres, at + 1).x;
    s.geometric_normal = normalize(ray.origin + hit.t * ray.direction - sphere.xyz);
    s.position = sphere.xyz + sphere.w * s.geometric_normal;
    s.offset = position_error(abs(sphere.xyz) + sphere.w);
}
#endif

// A miss gives some surface, which the caller must not use: on SIMD hardware a branch would not be cheaper.
Surface surface_at(Hit hit, Ray ray)
{
    hit.slot = hit.slot == NO_HIT ? 0u : hit.slot;
    Surface s = Surface(vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0), true, 0u);
    vec3 smooth_normal = s.geometric_normal;
#ifdef FX_TRIANGLES
    triangle_surface(hit, s, smooth_normal);
#endif
#ifdef FX_SPHERES
    if ((hit.slot & BVH_SPHERE_BIT) != 0u) {
        sphere_surface(hit, ray, s);
        smooth_normal = s.geometric_normal;
    }
#endif
    s.front = dot(s.geometric_normal, ray.direction) < 0.0;
    s.geometric_normal = s.front ? s.geometric_normal : -s.geometric_normal;
    smooth_normal = dot(smooth_normal, s.geometric_normal) >= 0.0 ? smooth_normal : -smooth_normal;
    // An interpolated normal that faces away from the viewer would turn the surface black.
    s.shading_normal = dot(smooth_normal, ray.direction) < 0.0 ? smooth_normal : s.geometric_normal;
    return s;
}

// A point just off the surface on the side `direction` leaves to.
// The offset follows from the coordinates' own rounding, so it scales with the scene: no absolute epsilon.
vec3 offset_origin(vec3 position, vec3 geometric_normal, float offset, vec3 direction)
{
    return position + geometric_normal * (dot(direction, geometric_normal) >= 0.0 ? offset : -offset);
}
