// What a triangle's corners carry besides their position, interpolated; and the same of spheres by formula.
#pragma once
#include "geometry/scene.glsl"
#include "lib/numbers.glsl"
#include "lib/packing.glsl"

// Weights of the three vertices.
vec3 corner_weights(vec2 barycentric) { return vec3(1.0 - barycentric.x - barycentric.y, barycentric); }

#ifdef FX_TRIANGLES

#ifdef FX_SHADING_NORMALS
// Unit; `geometric_normal` if the triangle is flat.
vec3 interpolated_normal(int triangle, vec3 weights, vec3 geometric_normal)
{
    const uvec4 coded = fetch_attribute(normals, triangle);
    const vec3 normal = normalize(weights.x * unpack_octahedral(coded.x) + weights.y * unpack_octahedral(coded.y)
        + weights.z * unpack_octahedral(coded.z));
    return coded.w != 0u ? normal : geometric_normal;
}
#endif

#ifdef FX_TEXTURES
// `precise`: masks decide by it what a ray meets.
vec2 interpolated_uv(uvec4 a, uvec4 b, vec3 weights)
{
    precise const vec2 uv
        = weights.x * uintBitsToFloat(a.xy) + weights.y * uintBitsToFloat(a.zw) + weights.z * uintBitsToFloat(b.xy);
    return uv;
}

void interpolated_uvs(int triangle, vec3 weights, out vec2 uv[2], out vec2 log2_uv_per_metre)
{
    const uvec4 a = fetch_attribute(uvs, triangle * UV_TEXELS);
    const uvec4 b = fetch_attribute(uvs, triangle * UV_TEXELS + 1);
    uv[0] = uv[1] = interpolated_uv(a, b, weights);
    log2_uv_per_metre = vec2(uintBitsToFloat(b.z));
#ifdef FX_SECOND_UVS
    const uvec4 c = fetch_attribute(uvs1, triangle * UV_TEXELS);
    const uvec4 d = fetch_attribute(uvs1, triangle * UV_TEXELS + 1);
    uv[1] = interpolated_uv(c, d, weights);
    log2_uv_per_metre.y = uintBitsToFloat(d.z);
#endif
}
#endif

#ifdef FX_NORMAL_MAPS
// xyz unit; w is the first corner's, for faces do not straddle a mirror seam.
vec4 interpolated_tangent(int triangle, vec3 weights)
{
    const uvec4 coded = fetch_attribute(tangents, triangle);
    const vec3 tangent = weights.x * unpack_octahedral(coded.x) + weights.y * unpack_octahedral(coded.y)
        + weights.z * unpack_octahedral(coded.z);
    return vec4(normalize(tangent), (coded.w & 1u) != 0u ? -1.0 : 1.0);
}
#endif

#ifdef FX_VERTEX_COLORS
vec4 unpack_color(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }

// A scene without colours has a single texel of zeros, which stands for white.
vec4 interpolated_color(int triangle, vec3 weights)
{
    if (textureSize(colors) < COLOR_TEXELS)
        return vec4(1.0);
    const uvec4 a = fetch_attribute(colors, triangle * COLOR_TEXELS);
    const uvec4 b = fetch_attribute(colors, triangle * COLOR_TEXELS + 1);
    return weights.x * unpack_color(a.xy) + weights.y * unpack_color(a.zw) + weights.z * unpack_color(b.xy);
}
#endif

#endif

// As on a globe with its north along +y, u = 0.5 along +z.
vec2 longitude_latitude(vec3 n)
{
    return vec2(0.5 + atan(n.x, n.z) / (2.0 * PI), acos(clamp(n.y, -1.0, 1.0)) / PI);
}

// Unit, where the longitude grows; +x at the poles.
vec3 east(vec3 n) { return n.x != 0.0 || n.z != 0.0 ? normalize(vec3(n.z, 0.0, -n.x)) : vec3(1.0, 0.0, 0.0); }
