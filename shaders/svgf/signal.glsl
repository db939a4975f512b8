// The kinds of signal the filter knows, and what two pixels of a kind are compared by.
//
//   SIGNAL_DIFFUSE    direct and indirect diffuse light, a pair (in_light, in_light_2) that shares its weights.
//                     Source: Schied et al. 2017, eq. 3 and 4.
//   SIGNAL_SPECULAR   light of the specular lobes. As above, and narrower the smoother the surface: a tap may be as far
//                     away as the lobe is wide. A mirror has no taps at all.
//   SIGNAL_SCATTERED  light scattered by fog before the first surface: what is beyond the same amount of fog shares
//                     its light, on surfaces and sky alike.
#pragma once
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

// Radiance rgb, luminance variance a. Of a single signal the second is zero all through.
struct Light {
    vec4 first;
    vec4 second;
};

Light load_light(ivec2 q)
{
#ifdef SIGNAL_PAIR
    return Light(imageLoad(in_light, q), imageLoad(in_light_2, q));
#else
    return Light(imageLoad(in_light, q), vec4(0.0));
#endif
}

void store_light(ivec2 px, vec4 first, vec4 second)
{
    imageStore(out_light, px, first);
#ifdef SIGNAL_PAIR
    imageStore(out_light_2, px, second);
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

struct Guide {
    FilterSurface surface;
    float alpha;
};

Guide guide_at(ivec2 q) { return Guide(unpack_surface(imageLoad(in_surface, q)), imageLoad(in_reflectance, q).a); }

// A lobe that is narrower than a pixel sees one thing, and its neighbour another.
bool takes_part(Guide g) { return g.surface.depth > 0.0 && g.alpha >= 0.5 * frame.camera.pixel_footprint; }

// A lobe is about alpha wide. A normal that turns by x turns what is mirrored by 2x: cos^n x is about
// exp(-n x^2 / 2), so n = 4 / alpha^2 makes exp(-(2x)^2 / (2 alpha^2)) of it; likewise for the view's own turn from
// pixel to pixel. Surfaces of another roughness show other things: a tenth of the larger is let through.
float edge_exponent(Guide p, Guide q, vec2 offset)
{
    const float reach = p.alpha / frame.camera.pixel_footprint;
    const float sharper = max(sigma_normal, 4.0 / (p.alpha * p.alpha));
    return depth_weight_exponent(p.surface, q.surface.depth, offset, sigma_depth)
        + normal_weight_exponent(p.surface.normal, q.surface.normal, sharper)
        + 0.5 * dot(offset, offset) / (reach * reach)
        + abs(p.alpha - q.alpha) / (0.1 * max(p.alpha, q.alpha));
}

#else

struct Guide {
    FilterSurface surface;
};

Guide guide_at(ivec2 q) { return Guide(unpack_surface(imageLoad(in_surface, q))); }

bool takes_part(Guide g) { return g.surface.depth > 0.0; }

float edge_exponent(Guide p, Guide q, vec2 offset)
{
    return depth_weight_exponent(p.surface, q.surface.depth, offset, sigma_depth)
        + normal_weight_exponent(p.surface.normal, q.surface.normal, sigma_normal);
}

#endif
#endif
