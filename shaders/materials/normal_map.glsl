// Shading normals from normal maps.
#pragma once
#include "geometry/surface.glsl"

#ifdef FX_NORMAL_MAPS
// A texel's tangent-space normal; +z where it says nothing.
vec3 decoded_normal(vec3 texel, float scale)
{
    const vec3 n = (texel * 2.0 - 1.0) * vec3(scale, scale, 1.0);
    return dot(n, n) > 0.0 ? n : vec3(0.0, 0.0, 1.0);
}

// From tangent space to the world, on the viewer's side.
vec3 mapped_normal(Surface s, vec3 n)
{
    const vec3 normal = s.front ? s.shading_normal : -s.shading_normal;
    precise const vec3 along = s.tangent.xyz - dot(normal, s.tangent.xyz) * normal;
    const vec3 tangent = dot(along, along) > 0.0 ? normalize(along) : basis_around(normal)[0];
    const vec3 bitangent = s.tangent.w * cross(normal, tangent);
    precise const vec3 mapped = normalize(n.x * tangent + n.y * bitangent + n.z * normal);
    return s.front ? mapped : -mapped;
}

// The normal nearest to `n` from which a mirror still reflects wo to above the geometric surface. Both that surface and
// the viewer are then on its side, and it changes smoothly where it starts to differ.
//
// Source: Keller et al. 2017, "The Iray Light Transport Simulation and Rendering System", appendix A.3. The least
// elevation, 1/100, is lowered for a viewer below it, so that the geometric normal itself always stays.
vec3 bent_normal(vec3 n, vec3 geometric_normal, vec3 wo)
{
    precise const float lean = dot(n, geometric_normal);
    precise const vec3 upright = lean < 0.0 ? n - 2.0 * lean * geometric_normal : n;
    precise const vec3 mirrored_wo = 2.0 * dot(upright, wo) * upright - wo;
    precise const float height = dot(mirrored_wo, geometric_normal);
    const float least = min(0.01, 0.9 * dot(wo, geometric_normal));
    precise const vec3 raised = mirrored_wo + (least - height) * geometric_normal;
    precise const vec3 half_way = wo + normalize(raised);
    // Of a viewer on the horizon who is mirrored to the horizon behind, rounding is all that is left: thousandths are
    // known to four digits, and what is not known at all is not greater either.
    const vec3 bent = dot(half_way, half_way) > 1e-6 ? normalize(half_way) : geometric_normal;
    return height >= least && dot(upright, wo) > 0.0 ? upright : bent;
}
#endif
