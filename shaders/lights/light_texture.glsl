// What a light's textures make of its radiance at a point: one random texel, whose mean is what the surface shows.
#pragma once
#include "lights/light_table.glsl"
#include "textures/texture.glsl"

#if defined(FX_LIGHTS) && defined(FX_TEXTURES)
uniform usamplerBuffer light_textures;

vec2 interpolated_uv(vec2 a, vec2 b, vec2 c, vec2 st) { return a + st.x * (b - a) + st.y * (c - a); }

// Factor on the light's radiance at p0 + s * edge_u + t * edge_v: the emission texture, and the part of the surface that
// is there.
vec3 light_texture(Light light, vec2 st, vec2 jitter)
{
    const int at = (max(int(light.texture_index), 1) - 1) * LIGHT_TEXTURE_TEXELS;
    const vec4 a = uintBitsToFloat(fetch_attribute(light_textures, at));
    const vec4 b = uintBitsToFloat(fetch_attribute(light_textures, at + 1));
    const vec4 c = uintBitsToFloat(fetch_attribute(light_textures, at + 2));
    const vec4 cover = uintBitsToFloat(fetch_attribute(light_textures, at + 3));
    const TextureRef emission
        = unpack_texture(fetch_attribute(light_textures, at + 4), fetch_attribute(light_textures, at + 5));
    const TextureRef opacity
        = unpack_texture(fetch_attribute(light_textures, at + 6), fetch_attribute(light_textures, at + 7));
    // Level 0: what is finer than the light is averaged by the choice of the point.
    const float finest = -1e30;
    const vec3 radiance
        = texture_stochastic(emission, interpolated_uv(a.xy, a.zw, b.xy, st), finest, vec3(jitter, 0.0)).rgb;
    float there = 1.0;
#ifdef FX_ALPHA
    // As geometry/coverage.glsl decides where a ray meets the light.
    const bool mask = cover.y >= 0.0;
    const vec2 uv = interpolated_uv(b.zw, c.xy, c.zw, st);
    const float filtered = cover.x * texture_filtered(opacity, uv, finest).a;
    const float one_texel = cover.x * texture_stochastic(opacity, uv, finest, vec3(jitter, 0.0)).a;
    there = mask ? (filtered >= cover.y ? 1.0 : 0.0) : one_texel;
#endif
    return light.texture_index != 0u ? radiance * there : vec3(1.0);
}
#elif defined(FX_LIGHTS)
vec3 light_texture(Light light, vec2 st, vec2 jitter) { return vec3(1.0); }
#endif
