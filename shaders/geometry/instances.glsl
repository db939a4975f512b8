// Instances: the space of an object's own tree, and back to the world's.
#pragma once
#include "geometry/scene.glsl"

// Instances are numbered from 1; 0 is the world's own space.
const uint NO_INSTANCE = 0u;

#ifdef FX_INSTANCES
// Rows of an affine matrix.
struct Transform {
    vec4 x;
    vec4 y;
    vec4 z;
};

Transform load_transform(usamplerBuffer source, int at)
{
    return Transform(uintBitsToFloat(fetch_attribute(source, at)), uintBitsToFloat(fetch_attribute(source, at + 1)),
        uintBitsToFloat(fetch_attribute(source, at + 2)));
}

int instance_at(uint instance) { return int(max(instance, 1u) - 1u) * INSTANCE_TEXELS; }

Transform object_from_world(uint instance)
{
    return load_transform(instances, instance_at(instance) + INSTANCE_OBJECT_FROM_WORLD);
}

Transform world_from_object(uint instance)
{
    return load_transform(instances, instance_at(instance) + INSTANCE_WORLD_FROM_OBJECT);
}

uvec4 instance_ids(uint instance) { return fetch_attribute(instances, instance_at(instance) + INSTANCE_IDS); }

// `precise`: equal transforms of last frame and this give equal bits, so that what rests has no motion.
vec3 transform_point(Transform m, vec3 p)
{
    precise const vec3 moved = vec3(dot(m.x.xyz, p), dot(m.y.xyz, p), dot(m.z.xyz, p)) + vec3(m.x.w, m.y.w, m.z.w);
    return moved;
}

vec3 transform_direction(Transform m, vec3 v)
{
    precise const vec3 moved = vec3(dot(m.x.xyz, v), dot(m.y.xyz, v), dot(m.z.xyz, v));
    return moved;
}

// By the transpose: takes normals from where `m` leads to back to where it comes from.
vec3 transform_normal(Transform m, vec3 n) { return n.x * m.x.xyz + n.y * m.y.xyz + n.z * m.z.xyz; }

// What the magnitudes of coordinates become at most, translation included.
vec3 transform_extent(Transform m, vec3 extent)
{
    return vec3(dot(abs(m.x), vec4(extent, 1.0)), dot(abs(m.y), vec4(extent, 1.0)), dot(abs(m.z), vec4(extent, 1.0)));
}

// Not unit: distances along it stay the world's.
Ray object_ray(uint instance, Ray ray)
{
    const Transform m = object_from_world(instance);
    return Ray(transform_point(m, ray.origin), transform_direction(m, ray.direction));
}
#endif
