// Rays, hits, and the tests against triangles, spheres and disks. Free of any buffer, so they can be tested alone.
#pragma once
#include "lib/numbers.glsl"

const float T_INFINITY = 1e30;
const uint NO_HIT = 0xffffffffu;

struct Ray {
    vec3 origin;
    vec3 direction;  // unit, but in an instance's space
};

struct Hit {
    float t;
    uint slot;         // BVH_TRIANGLES, BVH_SPHERES ... and the place among these in leaf order; NO_HIT if none
    vec2 barycentric;  // weights of the second and third vertex
#ifdef FX_INSTANCES
    uint instance;  // geometry/instances.glsl
#endif
};

Hit no_hit(float t_max)
{
#ifdef FX_INSTANCES
    return Hit(t_max, NO_HIT, vec2(0.0), 0u);
#else
    return Hit(t_max, NO_HIT, vec2(0.0));
#endif
}

// A ray prepared for the slab test and the watertight triangle test.
struct Traversal {
    vec3 origin;
    vec3 direction;
    vec3 lower_origin;  // of the slab test, from the lower and the upper side of boxes: geometry/traverse.glsl
    vec3 upper_origin;
    vec3 inverse_direction;  // finite
#ifdef FX_INSTANCES
    uint instance;  // whose space this is (geometry/instances.glsl)
    float stretch;  // length of the direction; exactly 1 in the world
    uint material;  // the instance's, with MATERIAL_HAS_HOLES
#endif
    vec3 shear;              // of Woop's test: x and y by z, and 1 / z of the permuted direction
    int axis;                // along which the direction is longest
};

// Rotates the components so that `axis` comes last; keeps handedness.
vec3 permute(vec3 v, int axis) { return axis == 0 ? v.yzx : axis == 1 ? v.zxy : v; }

Traversal prepare(Ray ray)
{
    Traversal t;
    t.origin = ray.origin;
#ifdef FX_INSTANCES
    t.instance = 0u;
    t.stretch = 1.0;
    t.material = 0u;
#endif
    // Of a unit vector 1e-30 is only what 1 / d cannot represent, and what would leave denormal edge functions of one
    // digit. It counts as none: then only slabs that hold the origin do not end the ray at once.
    const bvec3 moves = greaterThan(abs(ray.direction), vec3(1e-30));
    const vec3 d = mix(vec3(0.0), ray.direction, moves);
    t.direction = d;
    t.lower_origin = t.upper_origin = ray.origin;
    t.inverse_direction = mix(vec3(1e38), 1.0 / d, moves);
    const vec3 a = abs(d);
    t.axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
    const vec3 p = permute(d, t.axis);
    t.shear = vec3(p.x / p.z, p.y / p.z, 1.0 / p.z);
    return t;
}

// Distance to a triangle, or a negative number. Watertight: two triangles that share an edge or a vertex leave no
// gap, because each edge function is the difference of two rounded products of the same rounded operands and so
// never has the wrong sign; a zero counts as inside.
//
// Source: Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", JCGT 2(1).
// Differs from the paper: no fallback to double precision where an edge function is zero; both neighbours accept.
float intersect_triangle(Traversal ray, vec3 v0, vec3 v1, vec3 v2, float t_max, out vec2 barycentric)
{
    precise const vec3 a = permute(v0 - ray.origin, ray.axis);
    precise const vec3 b = permute(v1 - ray.origin, ray.axis);
    precise const vec3 c = permute(v2 - ray.origin, ray.axis);
    precise const vec2 a2 = a.xy - ray.shear.xy * a.z;
    precise const vec2 b2 = b.xy - ray.shear.xy * b.z;
    precise const vec2 c2 = c.xy - ray.shear.xy * c.z;
    precise const float u = c2.x * b2.y - c2.y * b2.x;
    precise const float v = a2.x * c2.y - a2.y * c2.x;
    precise const float w = b2.x * a2.y - b2.y * a2.x;
    precise const float determinant = u + v + w;
    precise const float t = (u * a.z + v * b.z + w * c.z) * ray.shear.z / determinant;
    const bool outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
    barycentric = vec2(v, w) / determinant;
    return !outside && determinant != 0.0 && t > 0.0 && t < t_max ? t : -1.0;
}

// Distance to a sphere's first side beyond t_min, or a negative number. t_min is 0 or what this returned before.
//
// Source: Haines, Günther, Akenine-Möller 2019, "Precision Improvements for Ray/Sphere Intersection",
// Ray Tracing Gems, chapter 7: the discriminant from the rejection vector, the roots without cancellation.
float intersect_sphere(Traversal ray, vec3 center, float radius, float t_min, float t_max)
{
    vec3 direction = ray.direction;
#ifdef FX_INSTANCES
    direction /= ray.stretch;
#endif
    precise const vec3 f = ray.origin - center;
    precise const float b = -dot(f, direction);
    precise const vec3 rejection = f + b * direction;
    precise const float discriminant = radius * radius - dot(rejection, rejection);
    if (!(discriminant >= 0.0))
        return -1.0;
    precise const float c = dot(f, f) - radius * radius;
    precise const float q = b + (b >= 0.0 ? sqrt(discriminant) : -sqrt(discriminant));
    float other = q != 0.0 ? c / q : 0.0;  // q = 0: the ray grazes the sphere where it starts
    float one = q;
#ifdef FX_INSTANCES
    one /= ray.stretch;
    other /= ray.stretch;
#endif
    const float t_a = min(one, other);
    const float t_b = max(one, other);
    const float t = t_a > t_min ? t_a : t_b;
    return t > t_min && t < t_max ? t : -1.0;
}

// Distance to a disk, or a negative number. Seen edge-on it is not met.
float intersect_disk(Traversal ray, vec3 center, vec3 normal, float radius, float t_max)
{
    precise const vec3 to_center = center - ray.origin;
    precise const float along = dot(ray.direction, normal);
    precise const float t = dot(to_center, normal) / along;
    precise const vec3 from_center = t * ray.direction - to_center;
    const bool inside = dot(from_center, from_center) <= radius * radius;
    return along != 0.0 && inside && t > 0.0 && t < t_max ? t : -1.0;
}
