// Homogeneous fog in a sphere about the scene: absorption and scattering per channel, phase function of
// Henyey and Greenstein. A sphere, not all of space: through endless fog no light from outside would arrive.
//
// Free of any uniform, so that it can be tested alone. A sigma_t of zero stands for no fog, on which callers branch.
//
// Sources: Henyey and Greenstein 1941, "Diffuse radiation in the Galaxy"; Wilkie et al. 2014, "Hero Wavelength
// Spectral Sampling" (one channel chooses the distance, all channels weigh it); Kulla and Fajardo 2012, "Importance
// Sampling Techniques for Path Tracing in Participating Media" (distances within a segment).
#pragma once
#include "lib/numbers.glsl"
#include "lib/sampling.glsl"

struct Fog {
    vec3 sigma_t;  // extinction [1/m]
    vec3 sigma_s;  // scattering [1/m]
    float g;       // mean cosine, in (-1, 1)
    vec3 center;   // of the sphere it fills [m]
    float radius;  // [m]
};

// The part [x, y] of the ray between 0 and t_max that runs in fog; x = y where there is none.
vec2 fog_span(Fog fog, vec3 origin, vec3 direction, float t_max)
{
    const vec3 f = origin - fog.center;
    const float middle = -dot(f, direction);
    const vec3 rejection = f + middle * direction;
    const float half2 = fog.radius * fog.radius - dot(rejection, rejection);
    const float half_chord = sqrt(max(0.0, half2));
    const float enter = clamp(middle - half_chord, 0.0, t_max);
    return vec2(enter, max(enter, min(middle + half_chord, t_max)));
}

vec3 fog_transmittance(Fog fog, float way) { return exp(-fog.sigma_t * way); }

struct FogEvent {
    bool scattered;  // else the whole way was passed
    float way;       // until there [m]
    vec3 weight;     // of the path: scattering * transmittance / density, or transmittance / probability
};

// A free path within `length`. u.x: distance, u.y: channel.
FogEvent sample_fog(Fog fog, float length, vec2 u)
{
    const float channel = u.y * 3.0;
    const float sigma = channel < 1.0 ? fog.sigma_t.x : channel < 2.0 ? fog.sigma_t.y : fog.sigma_t.z;
    // log(1 - u) is finite: u < 1. A channel without extinction passes.
    const float way = sigma > 0.0 ? -log(1.0 - u.x) / sigma : length;
    FogEvent e;
    e.scattered = way < length;
    e.way = e.scattered ? way : length;
    const vec3 passed = fog_transmittance(fog, e.way);
    const float density = dot(fog.sigma_t, passed) / 3.0;
    const float survival = (passed.x + passed.y + passed.z) / 3.0;
    e.weight = e.scattered ? fog.sigma_s * passed / density : passed / survival;
    return e;
}

// 1 - exp(-x) for x >= 0; below 1e-2 by its series, whose next term is 1e-9 of it.
vec3 one_minus_exp(vec3 x)
{
    return mix(1.0 - exp(-x), x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0))), lessThan(x, vec3(1e-2)));
}

// A point where light is scattered within `length`, which is certain: its weight carries the chance.
FogEvent sample_fog_within(Fog fog, float length, vec2 u)
{
    const vec3 depth = fog.sigma_t * length;
    const vec3 opacity = one_minus_exp(depth);
    const float channel = u.y * 3.0;
    const int c = channel < 1.0 ? 0 : channel < 2.0 ? 1 : 2;
    // Where next to nothing is absorbed distances are uniform.
    const bool thin = !(depth[c] >= 1e-4);
    const float way = thin ? u.x * length : -log(max(1.0 - u.x * opacity[c], 1e-37)) / fog.sigma_t[c];
    FogEvent e;
    e.scattered = true;
    e.way = min(way, length);
    const vec3 passed = fog_transmittance(fog, e.way);
    const vec3 densities = mix(fog.sigma_t * passed / opacity, vec3(1.0 / length), lessThan(depth, vec3(1e-4)));
    const float density = (densities.x + densities.y + densities.z) / 3.0;
    e.weight = length > 0.0 ? fog.sigma_s * passed / density : vec3(0.0);
    return e;
}

// Per solid angle [1/sr]; `cosine` between the ways of the light before and after. Its own density.
float fog_phase(Fog fog, float cosine)
{
    const float g2 = fog.g * fog.g;
    const float s = max(1.0 + g2 - 2.0 * fog.g * cosine, 1e-12);
    return (1.0 - g2) / (4.0 * PI * s * sqrt(s));
}

// A direction by the phase function, for light that comes along `forward`. The usual inversion, rearranged so that
// nothing is divided by g: with v = 2u - 1 and s = (1 - g^2) / (1 + g v),
// cos = ((v + g) (1 + s) / (1 + g v) + g) / 2, which is v for g = 0.
vec3 sample_fog_phase(Fog fog, vec3 forward, vec2 u)
{
    const float v = 2.0 * u.x - 1.0;
    const float below = 1.0 / (1.0 + fog.g * v);
    const float s = (1.0 - fog.g * fog.g) * below;
    const float cosine = clamp(0.5 * ((v + fog.g) * (1.0 + s) * below + fog.g), -1.0, 1.0);
    const float sine = sqrt(max(0.0, 1.0 - cosine * cosine));
    const float phi = 2.0 * PI * u.y;
    return normalize(basis_around(forward) * vec3(sine * cos(phi), sine * sin(phi), cosine));
}
