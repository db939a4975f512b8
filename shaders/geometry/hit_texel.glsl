// A hit in one texel of the G-buffer, so that a later pass finds the surface again without tracing.
#pragma once
#include "geometry/ray.glsl"
#include "shared/scene_layout.h"

// A triangle's point follows from its barycentric weights, any other's from the distance.
uvec4 pack_hit(Hit hit)
{
    const bool triangle = (hit.slot & BVH_KIND_MASK) == BVH_TRIANGLES;
    const vec2 place = triangle ? hit.barycentric : vec2(hit.t, 0.0);
#ifdef FX_INSTANCES
    return uvec4(hit.slot, hit.instance, floatBitsToUint(place));
#else
    return uvec4(hit.slot, 0u, floatBitsToUint(place));
#endif
}

Hit unpack_hit(uvec4 texel)
{
    const vec2 place = uintBitsToFloat(texel.zw);
    const bool triangle = (texel.x & BVH_KIND_MASK) == BVH_TRIANGLES;
    Hit hit;
    hit.t = triangle ? 0.0 : place.x;
    hit.slot = texel.x;
#ifdef FX_INSTANCES
    hit.instance = texel.y;
#endif
    hit.barycentric = triangle ? place : vec2(0.0);
    return hit;
}
