// The kinds of signal the filter knows, and what two pixels of a kind are compared by.
//
//   SIGNAL_DIFFUSE    direct and indirect diffuse light, a pair (in_light, in_light_2) that shares its weights.
//                     Source: Schied et al. 2017, eq. 3 and 4.
//   SIGNAL_SPECULAR   light of the specular lobes. As above; besides, two pixels either are no further apart than their
//                     lobes are wide, or show the same thing: it is as far away, lies alike and has the same colour.
//   SIGNAL_SCATTERED  light scattered by fog before the first surface: what is beyond the same amount of fog shares
//                     its light, on surfaces and sky alike.
#pragma once
#include "lib/unknown.glsl"
#include "svgf/noise.glsl"
#include "svgf/surface.glsl"

#ifdef SIGNAL_DIFFUSE
#define SIGNAL_PAIR
#endif

layout(rgba32f) readonly uniform image2D in_light;
uniform writeonly image2D out_light;
#ifdef SIGNAL_PAIR
layout(rgba32f) readonly uniform image2D in_light_2;
uniform writeonly image2D out_light_2;
#endif

// Radiance rgb, luminance variance a, and the half differences of both (svgf/noise.glsl). Of a single signal the second
// is zero all through.
struct Light {
    vec4 first;
    vec4 second;
    vec2 half_difference;
    bool known;  // else it takes part in nothing
};

Light load_light(ivec2 q)
{
    const vec4 first = imageLoad(in_light, q);
#ifdef SIGNAL_PAIR
    const vec4 second = imageLoad(in_light_2, q);
#else
    const vec4 second = vec4(0.0);
#endif
    return Light(vec4(first.rgb, variance_in(first.a)), vec4(second.rgb, variance_in(second.a)),
        vec2(half_difference_in(first.a), half_difference_in(second.a)), is_light(first) && is_light(second));
}

// The light that a pixel itself brings, nothing where it is not known.
Light load_own_light(uint stage, ivec2 px)
{
    const Light light = load_light(px);
    note(stage, kinds_in(light.first.rgb, light.second.rgb));
    return light.known ? light : Light(vec4(0.0), vec4(0.0), vec2(0.0), false);
}

void store_light(uint stage, ivec2 px, Light light)
{
    const vec2 variance = vec2(light.first.a, light.second.a);
    const uint kinds = kinds_in(light.first.rgb, light.second.rgb) | kinds_in(vec3(variance, 0.0));
    note(stage, light.known ? kinds : 0u);
    note(stage, light.known && max(variance.x, variance.y) > MOST_VARIANCE ? IS_CLAMPED : 0u);
    if (!light.known || kinds != 0u)
        light = Light(vec4(unknown_light(), 0.0), vec4(unknown_light(), 0.0), vec2(0.0), false);
    imageStore(out_light, px, vec4(light.first.rgb, pack_noise(light.first.a, light.half_difference.x)));
#ifdef SIGNAL_PAIR
    imageStore(out_light_2, px, vec4(light.second.rgb, pack_noise(light.second.a, light.half_difference.y)));
#endif
}

#ifdef SIGNAL_SCATTERED

layout(r32f) readonly uniform image2D in_fog_way;  // way through fog before the first surface [m]
uniform vec3 fog_sigma_t;

struct Guide {
    float transmittance;  // of the fog before the surface
};

Guide guide_at(ivec2 q) { return Guide(luminance(exp(-fog_sigma_t * imageLoad(in_fog_way, q).x))); }

bool takes_part(Guide g) { return true; }

// Two pixels lit alike differ by as much as their opacities do: 5 % of the whole are let through.
float edge_exponent(Guide p, Guide q, vec2 offset) { return abs(p.transmittance - q.transmittance) / 0.05; }

#else

layout(rgba32ui) readonly uniform uimage2D in_surface;
uniform float sigma_depth;
uniform float sigma_normal;

#ifdef SIGNAL_SPECULAR

layout(rgba32f) readonly uniform image2D in_reflectance;  // a: GGX alpha, negative where nothing is specular
layout(rgba32ui) readonly uniform uimage2D in_shown;      // what a path found that followed the lobes

struct Guide {
    FilterSurface surface;
    float alpha;
    float distance;  // of what is shown [m], 0: not known
    vec3 normal;
    vec3 albedo;
};

Guide guide_at(ivec2 q)
{
    const uvec4 shown = imageLoad(in_shown, q);
    return Guide(unpack_surface(imageLoad(in_surface, q)), imageLoad(in_reflectance, q).a, uintBitsToFloat(shown.x),
        unpack_octahedral(shown.y), unpackUnorm4x8(shown.z).rgb);
}

bool takes_part(Guide g) { return is_depth(g.surface.depth) && g.alpha >= 0.0; }

// A lobe is about alpha wide. A normal that turns by x turns what is mirrored by 2x: cos^n x is about
// exp(-n x^2 / 2), so n = 4 / alpha^2 makes exp(-(2x)^2 / (2 alpha^2)) of it; likewise for the view's own turn from
// pixel to pixel. A mirror's lobe is narrower than a pixel: no other looks the same way.
float lobe_exponent(Guide p, Guide q, vec2 offset)
{
    const float width = max(p.alpha, 0.1 * frame.camera.pixel_footprint);
    const vec2 turn = offset * frame.camera.pixel_footprint / width;
    return normal_weight_exponent(p.surface.normal, q.surface.normal, max(sigma_normal, 4.0 / (width * width)))
        + 0.5 * dot(turn, turn);
}

// Different by a tenth of the way from the eye, by a normal as on surfaces, or by a tenth of white in colour: that is
// another thing. Where one of the two paths found nothing, four pixels around are good enough.
float shown_exponent(Guide p, Guide q, vec2 offset)
{
    const float way = p.surface.depth + p.distance;
    const vec3 tint = abs(p.albedo - q.albedo);
    const float differs = abs(p.distance - q.distance) / (0.1 * way)
        + normal_weight_exponent(p.normal, q.normal, sigma_normal) + max_component(tint) / 0.1;
    return p.distance > 0.0 && q.distance > 0.0 ? differs : dot(offset, offset) / (2.0 * 4.0 * 4.0);
}

float edge_exponent(Guide p, Guide q, vec2 offset)
{
    return depth_weight_exponent(p.surface, q.surface.depth, offset, sigma_depth)
        + min(lobe_exponent(p, q, offset), shown_exponent(p, q, offset))
        + abs(p.alpha - q.alpha) / (0.1 * max(max(p.alpha, q.alpha), 1e-4));
}

#else

struct Guide {
    FilterSurface surface;
};

Guide guide_at(ivec2 q) { return Guide(unpack_surface(imageLoad(in_surface, q))); }

bool takes_part(Guide g) { return is_depth(g.surface.depth); }

float edge_exponent(Guide p, Guide q, vec2 offset)
{
    return depth_weight_exponent(p.surface, q.surface.depth, offset, sigma_depth)
        + normal_weight_exponent(p.surface.normal, q.surface.normal, sigma_normal);
}

#endif
#endif
