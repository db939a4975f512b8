// Whether a surface with holes is there where a ray comes to it: a mask cuts at a threshold, a blend is there with the
// probability of its opacity. The choice is a function of ray, sample and primitive, so it is the same in every program.
#pragma once
#include "geometry/attributes.glsl"
#include "lib/random.glsl"
#include "textures/texture.glsl"

#ifdef FX_ALPHA
// Of the ray being traced; set by cover_by().
uvec4 coverage_key = uvec4(0u);

// Opacity of the material's constant, the texture and the vertex colours at a hit; `normal` is a sphere's there.
float opacity_at(Hit hit, uint material, uint flags, vec3 normal, vec3 u)
{
    const int at = int(material) * MATERIAL_TEXELS;
    float opacity = uintBitsToFloat(texelFetch(materials, at + MATERIAL_EMISSION).w);
    const int place = int(hit.slot & BVH_FIRST_MASK);
    const bool triangle = (hit.slot & BVH_KIND_MASK) == BVH_TRIANGLES;
    const vec3 weights = corner_weights(hit.barycentric);
#if defined(FX_VERTEX_COLORS) && defined(FX_TRIANGLES)
    if (triangle)
        opacity *= interpolated_color(place, weights).a;
#endif
#ifdef FX_TEXTURES
    const int map = at + MATERIAL_TEXTURES + MAP_ALBEDO * TEXTURE_TEXELS;
    const TextureRef t = unpack_texture(texelFetch(materials, map), texelFetch(materials, map + 1));
    vec2 uv[2] = vec2[2](vec2(0.0), vec2(0.0));
#ifdef FX_SPHERES
    if ((hit.slot & BVH_KIND_MASK) == BVH_SPHERES)
        uv[0] = uv[1] = longitude_latitude(normal);
#endif
#ifdef FX_TRIANGLES
    vec2 corner_uv[2];
    vec2 unused;
    interpolated_uvs(place, weights, corner_uv, unused);
    if (triangle)
        uv = corner_uv;
#endif
    // Level 0: coverage is averaged by samples, a coarser level's edges would be elsewhere.
    const float finest = -1e30;
    const vec2 at_uv = t.uv_set == 0 ? uv[0] : uv[1];
    const float filtered = texture_filtered(t, at_uv, finest).a;
    const float one_texel = texture_stochastic(t, at_uv, finest, u).a;
    opacity *= (flags & MATERIAL_ALPHA_MASK) != 0u ? filtered : one_texel;
#endif
    return opacity;
}

// `passed`: how far the ray went through the same primitive before.
bool is_covered(Hit hit, uint instance, uint material, vec3 normal, float passed)
{
    const uvec4 primitive = uvec4(hit.slot, instance, passed > 0.0 ? 1u : 0u, 0u);
    const vec4 u = vec4(pcg4d(coverage_key ^ pcg4d(primitive)) >> 8u) * exp2(-24.0);
    const int at = int(material) * MATERIAL_TEXELS;
    const uint flags = texelFetch(materials, at + MATERIAL_ALBEDO).w;
    const float cutoff = uintBitsToFloat(texelFetch(materials, at + MATERIAL_COAT).w);
    const float opacity = opacity_at(hit, material, flags, normal, u.xyz);
    return (flags & MATERIAL_ALPHA_MASK) != 0u ? opacity >= cutoff : u.w < opacity;
}
#endif

// The rays traced from now on draw their chances of being stopped by a blend from these numbers. Rays of one path must
// not share them: what let a ray through would then let every other through.
void cover_by(uvec2 px, uint seed, uint sample_index, uint bounce, uint slot)
{
#ifdef FX_ALPHA
    coverage_key = random_key(px, seed, sample_index, bounce, slot);
#endif
}
