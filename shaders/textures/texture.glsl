// Looking up a material's texture. Filtering and wrapping are done here over single texels, because images of any
// size share the layers of an array, each in its corner.
//
// The level of detail comes from ray cones: `lod_uv` is log2 of the cone's footprint on the surface, in units of the
// mesh's texture coordinates: log2_cone_width() and the surface's log2_uv_per_metre.
//
// Sources: Akenine-Möller et al. 2019, "Texture Level of Detail Strategies for Real-Time Ray Tracing", Ray Tracing
// Gems, chapter 20, section 20.3.4; Akenine-Möller et al. 2021, "Improved Shader and Texture Level of Detail Using Ray
// Cones", JCGT 10(1); Fajardo et al. 2023, "Stochastic Texture Filtering".
#pragma once
#include "shared/scene_layout.h"

struct TextureRef {
    bool used;  // else it is white
    bool nearest;
    uint array;
    int layer;
    int uv_set;
    uvec2 wrap;  // TEXTURE_REPEAT, ...
    ivec2 size;  // of level 0 [texels]
    vec2 column_u;  // image coordinates = column_u * u + column_v * v + offset
    vec2 column_v;
    vec2 offset;
};

// From the TEXTURE_TEXELS texels that a material keeps of it.
TextureRef unpack_texture(uvec4 a, uvec4 b)
{
    TextureRef t;
    t.used = (a.x & TEXTURE_USED) != 0u;
    t.nearest = (a.x & TEXTURE_NEAREST) != 0u;
    t.array = (a.x >> TEXTURE_ARRAY_SHIFT) & 7u;
    t.layer = int(a.x & 0xffffu);
    t.uv_set = (a.x & TEXTURE_UV_SET_1) != 0u ? 1 : 0;
    t.wrap = (uvec2(a.x) >> uvec2(TEXTURE_WRAP_U_SHIFT, TEXTURE_WRAP_V_SHIFT)) & 3u;
    t.size = max(ivec2(uvec2(a.y, a.y >> 16u) & 0xffffu), ivec2(1));
    t.offset = uintBitsToFloat(a.zw);
    t.column_u = uintBitsToFloat(b.xy);
    t.column_v = uintBitsToFloat(b.zw);
    return t;
}

// Width on a surface of a cone `width` [m] wide that meets it along `direction`, log2.
float log2_cone_width(float width, vec3 normal, vec3 direction)
{
    return log2(width / abs(dot(normal, direction)));
}

#ifdef FX_TEXTURES
uniform sampler2DArray texture_array_0;
#if TEXTURE_ARRAY_COUNT > 1
uniform sampler2DArray texture_array_1;
#endif
#if TEXTURE_ARRAY_COUNT > 2
uniform sampler2DArray texture_array_2;
#endif
#if TEXTURE_ARRAY_COUNT > 3
uniform sampler2DArray texture_array_3;
#endif
#if TEXTURE_ARRAY_COUNT > 4
uniform sampler2DArray texture_array_4;
#endif
#if TEXTURE_ARRAY_COUNT > 5
uniform sampler2DArray texture_array_5;
#endif

vec4 fetch_texel(TextureRef t, ivec2 texel, int level)
{
    const ivec3 at = ivec3(texel, t.layer);
    vec4 value = vec4(0.0);
    if (t.array == 0u)
        value = texelFetch(texture_array_0, at, level);
#if TEXTURE_ARRAY_COUNT > 1
    if (t.array == 1u)
        value = texelFetch(texture_array_1, at, level);
#endif
#if TEXTURE_ARRAY_COUNT > 2
    if (t.array == 2u)
        value = texelFetch(texture_array_2, at, level);
#endif
#if TEXTURE_ARRAY_COUNT > 3
    if (t.array == 3u)
        value = texelFetch(texture_array_3, at, level);
#endif
#if TEXTURE_ARRAY_COUNT > 4
    if (t.array == 4u)
        value = texelFetch(texture_array_4, at, level);
#endif
#if TEXTURE_ARRAY_COUNT > 5
    if (t.array == 5u)
        value = texelFetch(texture_array_5, at, level);
#endif
    return value;
}

// The image coordinate in [0, 1] that stands for any coordinate.
vec2 wrap_coordinate(TextureRef t, vec2 x)
{
    const vec2 repeated = x - floor(x);
    const vec2 mirrored = 1.0 - abs(1.0 - (x - 2.0 * floor(0.5 * x)));
    const vec2 clamped = clamp(x, 0.0, 1.0);
    return mix(mix(repeated, mirrored, equal(t.wrap, uvec2(TEXTURE_MIRROR))), clamped,
        equal(t.wrap, uvec2(TEXTURE_CLAMP)));
}

// The texel that stands for one at most a texel outside. The last clamp also keeps a NaN inside.
ivec2 wrap_texel(TextureRef t, ivec2 texel, ivec2 size)
{
    const ivec2 repeated = texel + mix(ivec2(0), size, lessThan(texel, ivec2(0)))
        - mix(ivec2(0), size, greaterThanEqual(texel, size));
    return clamp(mix(texel, repeated, equal(t.wrap, uvec2(TEXTURE_REPEAT))), ivec2(0), size - 1);
}

// What a lookup comes down to: a place on the image and a level, fractional where two are to be blended.
struct Lookup {
    vec2 at;  // [0, 1]
    float lod;
    bool nearest;  // one texel of level 0
};

int last_level(TextureRef t) { return findMSB(max(t.size.x, t.size.y)); }

Lookup lookup(TextureRef t, vec2 uv, float lod_uv)
{
    const vec2 at = t.column_u * uv.x + t.column_v * uv.y + t.offset;
    // Texels under a unit square of texture coordinates.
    const float texels
        = float(t.size.x) * float(t.size.y) * abs(t.column_u.x * t.column_v.y - t.column_u.y * t.column_v.x);
    const float lod = lod_uv + 0.5 * log2(texels);
    Lookup l;
    l.at = wrap_coordinate(t, at);
    l.lod = lod > 0.0 ? min(lod, float(last_level(t))) : 0.0;
    l.nearest = t.nearest && l.lod == 0.0;
    return l;
}

ivec2 level_size(TextureRef t, int level) { return max(t.size >> level, ivec2(1)); }

// The texel at `at` if `jitter` is a half; with uniform jitter in [0, 1)^2, one of the four texels around with the
// probability of its bilinear weight.
vec4 jittered_texel(TextureRef t, vec2 at, int level, vec2 jitter)
{
    const ivec2 size = level_size(t, level);
    return fetch_texel(t, wrap_texel(t, ivec2(floor(at * vec2(size) - 0.5 + jitter)), size), level);
}

vec4 bilinear(TextureRef t, vec2 at, int level)
{
    const ivec2 size = level_size(t, level);
    const vec2 x = at * vec2(size) - 0.5;
    const vec2 f = x - floor(x);
    const ivec2 lower = ivec2(floor(x));
    const ivec2 a = wrap_texel(t, lower, size);
    const ivec2 b = wrap_texel(t, lower + 1, size);
    return mix(mix(fetch_texel(t, a, level), fetch_texel(t, ivec2(b.x, a.y), level), f.x),
        mix(fetch_texel(t, ivec2(a.x, b.y), level), fetch_texel(t, b, level), f.x), f.y);
}

// Trilinear; `uv` as the mesh has it.
vec4 texture_filtered(TextureRef t, vec2 uv, float lod_uv)
{
    const Lookup l = lookup(t, uv, lod_uv);
    const int level = int(l.lod);
    const float blend = l.lod - float(level);
    vec4 value = vec4(0.0);
    // Loops, because llvmpipe would run a branch for every lane: the second level is wanted where textures are minified.
    int next = level;
    do {
        value += bilinear(t, l.at, next) * (next == level ? 1.0 - blend : blend);
        ++next;
    } while (blend > 0.0 && next <= level + 1);
    value = l.nearest ? jittered_texel(t, l.at, 0, vec2(0.5)) : value;
    return t.used ? value : vec4(1.0);
}

// One of the two levels around `lod`, the finer with the probability of its weight. Close to 1, u rounds the sum up to
// the next whole number: on the last level, to one that does not exist.
int random_level(TextureRef t, float lod, float u) { return min(int(lod + u), last_level(t)); }

// One texel, chosen with the weights of the trilinear filter by uniform `u`: its mean is texture_filtered().
vec4 texture_stochastic(TextureRef t, vec2 uv, float lod_uv, vec3 u)
{
    const Lookup l = lookup(t, uv, lod_uv);
    const int level = random_level(t, l.lod, u.z);
    const vec4 value = jittered_texel(t, l.at, level, l.nearest ? vec2(0.5) : u.xy);
    return t.used ? value : vec4(1.0);
}
#endif
