// Closest-hit and any-hit traversal of the four-wide tree.
//
// Loops within loops, not branches: llvmpipe runs both sides of an `if` for all lanes but leaves a loop
// once no lane is in it. The inner loop descends until every lane has a leaf or nothing; the leaf loop tests
// primitives. The stack holds what the scene's tree can need (BVH_STACK_SIZE, from the builder).
//
// Box test: Williams et al. 2005, "An Efficient and Robust Ray-Box Intersection Algorithm"; the far side is
// widened by 3 ulp after Ize 2013, "Robust BVH Ray Traversal", so that its own rounding never loses a box. That of the
// triangle test must not either: see widen_boxes().
#pragma once
#include "geometry/coverage.glsl"
#include "geometry/instances.glsl"
#include "geometry/ray.glsl"
#include "geometry/scene.glsl"

// The triangle test translates and shears vertices, so an edge may be off by roundings of the farthest vertex: a box
// that ends at the edge is widened by as much, as seen from the ray. It is also what keeps a box open to a ray that runs
// in the plane of its side.
//
// Source: Woop, Benthin, Wald 2013, section 4: 5 * 2^-24 of the scene's reach along the axis and the ray's longest one.
void widen_boxes(inout Traversal ray, uint root)
{
    const int at = int(root);
    const vec4 there = vec4(notEqual(texelFetch(bvh_nodes, at + 6), uvec4(BVH_NO_CHILD)));
    vec3 reach;
    for (int axis = 0; axis < 3; ++axis) {
        const vec4 lower = abs(uintBitsToFloat(texelFetch(bvh_nodes, at + axis)) - ray.origin[axis]);
        const vec4 upper = abs(uintBitsToFloat(texelFetch(bvh_nodes, at + axis + 3)) - ray.origin[axis]);
        const vec4 farther = max(lower, upper) * there;
        reach[axis] = max(max(farther.x, farther.y), max(farther.z, farther.w));
    }
    const vec3 aside = 5.0 * 5.9604645e-8 * (reach + permute(reach, ray.axis).z);
    ray.lower_origin = ray.origin + aside;
    ray.upper_origin = ray.origin - aside;
}

struct NodeHit {
    vec4 t;          // entry distance of each child, T_INFINITY if missed
    uvec4 children;  // child words
};

NodeHit intersect_node(Traversal ray, uint node, float t_max)
{
    const int at = int(node);
    const vec4 x0 = (uintBitsToFloat(texelFetch(bvh_nodes, at)) - ray.lower_origin.x) * ray.inverse_direction.x;
    const vec4 y0 = (uintBitsToFloat(texelFetch(bvh_nodes, at + 1)) - ray.lower_origin.y) * ray.inverse_direction.y;
    const vec4 z0 = (uintBitsToFloat(texelFetch(bvh_nodes, at + 2)) - ray.lower_origin.z) * ray.inverse_direction.z;
    const vec4 x1 = (uintBitsToFloat(texelFetch(bvh_nodes, at + 3)) - ray.upper_origin.x) * ray.inverse_direction.x;
    const vec4 y1 = (uintBitsToFloat(texelFetch(bvh_nodes, at + 4)) - ray.upper_origin.y) * ray.inverse_direction.y;
    const vec4 z1 = (uintBitsToFloat(texelFetch(bvh_nodes, at + 5)) - ray.upper_origin.z) * ray.inverse_direction.z;
    const vec4 enter = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), vec4(0.0)));
    const vec4 leave = min(min(max(x0, x1), max(y0, y1)), max(z0, z1)) * 1.0000004;
    const bvec4 hit = lessThanEqual(enter, min(leave, vec4(t_max)));
    return NodeHit(mix(vec4(T_INFINITY), enter, hit), texelFetch(bvh_nodes, at + 6));
}

// Orders two children by distance.
void order(inout float t_a, inout float t_b, inout uint a, inout uint b)
{
    const bool swap = t_b < t_a;
    const float t = t_a;
    const uint c = a;
    t_a = swap ? t_b : t_a;
    a = swap ? b : a;
    t_b = swap ? t : t_b;
    b = swap ? c : b;
}

void record(inout Hit hit, Traversal ray, float t, uint slot, vec2 barycentric)
{
    hit.t = t;
    hit.slot = slot;
    hit.barycentric = barycentric;
#ifdef FX_INSTANCES
    hit.instance = ray.instance;
#endif
}

// A hit of something with holes, to be looked into before it counts.
struct Candidate {
    bool waits;
    uint nearest;  // rank of the nearest hit so far
#ifdef FX_ALPHA
    Hit hit;
    uint rank;
    uint material;
    vec3 normal;   // of a sphere
    float passed;  // along the ray, of the primitive being tested
#endif
};

// Of two hits in one place that of the lower rank is seen, whatever order the tree has: of the world's triangles those
// of the object that the scene names first, spheres and disks by their place, then instances in their order.
uint rank_in(Traversal ray, uint rank)
{
#ifdef FX_INSTANCES
    return ray.instance != NO_INSTANCE ? 0x80000000u | ray.instance : rank;
#else
    return rank;
#endif
}

// Takes what the ray met as the nearest hit, or as a candidate for it. `material` as the primitive names it.
void accept(inout Hit hit, inout Candidate candidate, Traversal ray, float t, uint rank, uint slot, vec2 barycentric,
    uint material)
{
#ifdef FX_ALPHA
    candidate.rank = rank;
#ifdef FX_INSTANCES
    material = ray.instance != NO_INSTANCE ? ray.material : material;
#endif
    candidate.waits = (material & MATERIAL_HAS_HOLES) != 0u;
    candidate.material = material & ~MATERIAL_HAS_HOLES;
    record(candidate.hit, ray, t, slot, barycentric);
    if (candidate.waits)
        return;
#endif
    candidate.nearest = rank;
    record(hit, ray, t, slot, barycentric);
}

void intersect_primitive(Traversal ray, uint leaf, uint k, inout Hit hit, inout Candidate candidate)
{
    const uint slot = (leaf & (BVH_KIND_MASK | BVH_FIRST_MASK)) + k;
    const int place = int(slot & BVH_FIRST_MASK);
    const uint kind = leaf & BVH_KIND_MASK;
    // As far as the nearest hit and with it, for ties.
    const float limit = hit.slot == NO_HIT ? hit.t : uintBitsToFloat(floatBitsToUint(hit.t) + 1u);
#ifdef FX_TRIANGLES
    {
        const int at = place * TRIANGLE_TEXELS;
        const uvec4 a = texelFetch(triangles, at);
        const uvec4 b = texelFetch(triangles, at + 1);
        vec2 barycentric;
        const float t = intersect_triangle(ray, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz),
            uintBitsToFloat(texelFetch(triangles, at + 2).xyz), limit, barycentric);
        const uint rank = rank_in(ray, a.w);
        if (t > 0.0 && (t < hit.t || rank < candidate.nearest) && kind == BVH_TRIANGLES)
            accept(hit, candidate, ray, t, rank, slot, barycentric, b.w);
    }
#endif
#ifdef FX_SPHERES
    {
        const vec4 sphere = uintBitsToFloat(texelFetch(spheres, place * SPHERE_TEXELS));
#ifdef FX_ALPHA
        const float t = intersect_sphere(ray, sphere.xyz, sphere.w, candidate.passed, limit);
        const uint material = texelFetch(spheres, place * SPHERE_TEXELS + 1).y;
        const vec3 normal = normalize(ray.origin + t * ray.direction - sphere.xyz);
#else
        const float t = intersect_sphere(ray, sphere.xyz, sphere.w, 0.0, limit);
        const uint material = 0u;
#endif
        const uint rank = rank_in(ray, uint(place));
        if (t > 0.0 && (t < hit.t || rank < candidate.nearest) && kind == BVH_SPHERES) {
            accept(hit, candidate, ray, t, rank, slot, vec2(0.0), material);
#ifdef FX_ALPHA
            candidate.normal = normal;
#endif
        }
    }
#endif
#ifdef FX_DISKS
    {
        const vec4 disk = uintBitsToFloat(texelFetch(disks, place * DISK_TEXELS));
        const vec3 normal = uintBitsToFloat(texelFetch(disks, place * DISK_TEXELS + 1).xyz);
        const float t = intersect_disk(ray, disk.xyz, normal, disk.w, limit);
#ifdef FX_ALPHA
        const uint material = texelFetch(disks, place * DISK_TEXELS + 2).y;
#else
        const uint material = 0u;
#endif
        const uint rank = rank_in(ray, uint(place));
        if (t > 0.0 && (t < hit.t || rank < candidate.nearest) && kind == BVH_DISKS)
            accept(hit, candidate, ray, t, rank, slot, vec2(0.0), material);
    }
#endif
}

uint leaf_count(uint leaf) { return ((leaf >> BVH_COUNT_SHIFT) & 3u) + 1u; }

#ifdef FX_INSTANCES
// Stands on the stack below an instance's tree: there the ray goes back to the world.
const uint LEAVE_INSTANCE = 0xffffffffu;

bool changes_space(uint node) { return node >= (BVH_LEAF_BIT | BVH_INSTANCES); }

Traversal prepare_in(uint instance, Ray ray)
{
    const Ray local = object_ray(instance, ray);
    Traversal t = prepare(local);
    t.instance = instance;
    t.stretch = length(local.direction);
    const uvec4 ids = instance_ids(instance);
    t.material = ids.z;
    widen_boxes(t, ids.x);
    return t;
}
#endif

#ifdef FX_ALPHA
bool is_covered(Candidate c, Traversal ray)
{
#ifdef FX_INSTANCES
    return is_covered(c.hit, ray.instance, c.material, c.normal, c.passed);
#else
    return is_covered(c.hit, NO_INSTANCE, c.material, c.normal, c.passed);
#endif
}
#endif

bool holds_primitives(uint node)
{
#ifdef FX_INSTANCES
    return node > BVH_NO_CHILD && !changes_space(node);
#else
    return node != BVH_NO_CHILD;
#endif
}

// Children are visited nearest first, for shadow rays too: what blocks a ray is more often near than far.
Hit traverse(Ray r, float t_max, const bool first_hit_ends)
{
    Traversal world_ray = prepare(r);
    widen_boxes(world_ray, 0u);
    Traversal ray = world_ray;
    Hit hit = no_hit(t_max);
    uint stack[BVH_STACK_SIZE];
    int depth = 0;
    // A ray with NaN or infinity in it would open every box: comparisons with NaN are the device's choice.
    uint node = t_max > 0.0 && is_finite(dot(r.origin, r.direction)) ? 0u : BVH_NO_CHILD;
    uint k = 0u;  // next primitive of the leaf `node`
    Candidate candidate;
    candidate.waits = false;
    candidate.nearest = 0u;
#ifdef FX_ALPHA
    candidate.hit = hit;
    candidate.rank = 0u;
    candidate.material = 0u;
    candidate.normal = vec3(0.0);
    candidate.passed = 0.0;
#endif
    // A loop around the loops, for what is rare: every lane that still runs has come to where it changes space or has
    // to look into a candidate before any does.
    do {
        do {
            do {
                const bool inner = node < BVH_NO_CHILD;
                NodeHit box = intersect_node(ray, inner ? node : 0u, hit.t);
                order(box.t.x, box.t.y, box.children.x, box.children.y);
                order(box.t.z, box.t.w, box.children.z, box.children.w);
                order(box.t.x, box.t.z, box.children.x, box.children.z);
                order(box.t.y, box.t.w, box.children.y, box.children.w);
                order(box.t.y, box.t.z, box.children.y, box.children.z);
                if (inner) {
                    if (box.t.w < T_INFINITY)
                        stack[depth++] = box.children.w;
                    if (box.t.z < T_INFINITY)
                        stack[depth++] = box.children.z;
                    if (box.t.y < T_INFINITY)
                        stack[depth++] = box.children.y;
                    node = box.children.x;
                    if (!(box.t.x < T_INFINITY))
                        node = depth > 0 ? stack[--depth] : BVH_NO_CHILD;
                }
            } while (node < BVH_NO_CHILD);

            if (holds_primitives(node)) {
                do {
                    intersect_primitive(ray, node, k, hit, candidate);
                    ++k;
#ifdef FX_ALPHA
                    candidate.passed = candidate.waits ? candidate.passed : 0.0;
#endif
                } while (k < leaf_count(node) && !candidate.waits);
                if (!candidate.waits) {
                    const bool ended = first_hit_ends && hit.slot != NO_HIT;
                    node = depth > 0 && !ended ? stack[--depth] : BVH_NO_CHILD;
                    k = 0u;
                }
            }
        } while ((holds_primitives(node) || node < BVH_NO_CHILD) && !candidate.waits);
#ifdef FX_ALPHA
        const bool covered = is_covered(candidate, ray);
        if (candidate.waits) {
            candidate.waits = false;
            if (covered) {
                hit = candidate.hit;
                candidate.nearest = candidate.rank;
            }
            // What lies behind the near side of a sphere is its far side.
            const bool again = !covered && candidate.passed == 0.0 && (candidate.hit.slot & BVH_KIND_MASK) == BVH_SPHERES;
            candidate.passed = again ? candidate.hit.t : 0.0;
            k -= again ? 1u : 0u;
            if (k == leaf_count(node) || (first_hit_ends && covered)) {
                node = depth > 0 && !(first_hit_ends && covered) ? stack[--depth] : BVH_NO_CHILD;
                k = 0u;
            }
        }
#endif
#ifdef FX_INSTANCES
        const bool leaves = node == LEAVE_INSTANCE;
        const bool enters = changes_space(node) && !leaves;
        const uint instance = enters ? (node & BVH_FIRST_MASK) + 1u : 1u;
        const Traversal local_ray = prepare_in(instance, r);
        if (enters) {
            stack[depth++] = LEAVE_INSTANCE;
            ray = local_ray;
            node = instance_ids(instance).x;
        }
        if (leaves) {
            ray = world_ray;
            node = depth > 0 ? stack[--depth] : BVH_NO_CHILD;
        }
#endif
    } while (node != BVH_NO_CHILD);
    return hit;
}

// The nearest hit with 0 < t < t_max; t_max <= 0 traverses nothing.
Hit closest_hit(Ray ray, float t_max) { return traverse(ray, t_max, false); }

// Whether anything lies within 0 < t < t_max; t_max <= 0 traverses nothing.
bool any_hit(Ray ray, float t_max) { return traverse(ray, t_max, true).slot != NO_HIT; }
