// What a ray meets that leaves the scene: one radiance, or a map of it all around, which is sampled as a light.
//
// A constant environment is not: following the BSDF finds it as well as anything could.
// Source: Pharr et al. 2023, "Physically Based Rendering", 4th ed., section 12.5.
#pragma once
#include "lib/frame.glsl"
#include "lib/numbers.glsl"
#include "lights/light_sample.glsl"
#include "lights/light_table.glsl"
#include "shared/scene_layout.h"

#ifdef FX_ENVIRONMENT_MAP
uniform usamplerBuffer environment;

// Width and height [texels]; 0: no map.
ivec2 environment_size() { return ivec2(texelFetch(environment, 0).xy); }

mat3 map_from_world()
{
    return transpose(mat3(uintBitsToFloat(texelFetch(environment, 1).xyz),
        uintBitsToFloat(texelFetch(environment, 2).xyz), uintBitsToFloat(texelFetch(environment, 3).xyz)));
}

// Radiance and density of texel (x, y) inside the map.
vec4 environment_texel(ivec2 size, ivec2 texel)
{
    return uintBitsToFloat(texelFetch(environment, ENVIRONMENT_HEADER_TEXELS + texel.y * size.x + texel.x));
}

// Where on the map, in [0, 1]^2. Directions near a pole keep their digits; at the pole itself any longitude will do.
vec2 environment_place(vec3 direction)
{
    const vec3 d = map_from_world() * direction;
    const float across = length(d.xz);
    return vec2(0.5 + (across > 0.0 ? atan(d.x, -d.z) / (2.0 * PI) : 0.0), atan(across, d.y) / PI);
}

// Bilinear; the left edge continues at the right.
vec3 map_radiance(ivec2 size, vec2 place)
{
    const vec2 x = place * vec2(size) - 0.5;
    const vec2 f = x - floor(x);
    const ivec2 a = ivec2(floor(x));
    const int left = a.x < 0 ? size.x - 1 : min(a.x, size.x - 1);
    const int right = left + 1 < size.x ? left + 1 : 0;
    const int upper = clamp(a.y, 0, size.y - 1);
    const int lower = clamp(a.y + 1, 0, size.y - 1);
    const vec3 top = mix(environment_texel(size, ivec2(left, upper)).rgb,
        environment_texel(size, ivec2(right, upper)).rgb, f.x);
    const vec3 bottom = mix(environment_texel(size, ivec2(left, lower)).rgb,
        environment_texel(size, ivec2(right, lower)).rgb, f.x);
    return mix(top, bottom, f.y);
}
#endif

// Radiance from where `direction` (unit) points to; black without environment.
vec3 environment_radiance(vec3 direction)
{
    vec3 radiance = vec3(0.0);
#ifdef FX_BACKGROUND
    radiance = frame.background;
#endif
#ifdef FX_ENVIRONMENT_MAP
    const ivec2 size = environment_size();
    if (size.x > 0)
        radiance *= map_radiance(size, environment_place(direction));
#endif
    return radiance;
}

#if defined(FX_LIGHTS) && defined(FX_ENVIRONMENT_MAP)
// u.xy choose a texel and the place in it, u.z between a texel and its alias. Vose 1991.
LightSample sample_environment(vec3 u)
{
    const ivec2 size = environment_size();
    LightSample s = NO_LIGHT_SAMPLE;
    if (!(size.x > 0))
        return s;
    const vec2 x = u.xy * vec2(size);
    ivec2 texel = min(ivec2(x), size - 1);
    const vec2 jitter = x - floor(x);
    const int slot = texel.y * size.x + texel.x;
    const uvec4 pair = texelFetch(environment, ENVIRONMENT_HEADER_TEXELS + size.x * size.y + slot / 2);
    const uvec2 alias = (slot & 1) == 0 ? pair.xy : pair.zw;
    if (!(u.z < uintBitsToFloat(alias.x)))
        texel = ivec2(int(alias.y) % size.x, int(alias.y) / size.x);

    // Uniform over the texel's solid angle: in sin^2 of half the angle from the nearer pole, which keeps its digits.
    const bool south = 2 * texel.y >= size.y;
    const float row = float(south ? size.y - 1 - texel.y : texel.y);
    const vec2 edges = sin(vec2(row, row + 1.0) * (0.5 * PI / float(size.y)));
    const float t = mix(edges.x * edges.x, edges.y * edges.y, jitter.y);
    const float across = 2.0 * sqrt(t * (1.0 - t));
    const float up = south ? 2.0 * t - 1.0 : 1.0 - 2.0 * t;
    const float longitude = 2.0 * PI * ((float(texel.x) + jitter.x) / float(size.x) - 0.5);
    s.wi = vec3(across * sin(longitude), up, -across * cos(longitude)) * map_from_world();
    s.infinite = true;
    s.pdf = environment_texel(size, texel).w;
    s.radiance = environment_radiance(s.wi);
    return s;
}
#endif

// The density with which sample_lights() finds `direction` on the environment, whatever the shading point.
float environment_pdf(vec3 direction)
{
#if defined(FX_LIGHTS) && defined(FX_ENVIRONMENT_MAP)
    const ivec2 size = environment_size();
    if (size.x > 0) {
        const ivec2 texel = clamp(ivec2(environment_place(direction) * vec2(size)), ivec2(0), size - 1);
        return environment_texel(size, texel).w * load_light(frame.light_count - 1u).pmf;
    }
#endif
    return 0.0;
}
