// From scene-linear radiance to display values. Total functions: any input, NaN included, lands in [0, 1].
#pragma once
#include "lib/numbers.glsl"

const float MOST_DISPLAYABLE = 1e30;

// NaN becomes 0, +Inf the largest value.
vec3 displayable(vec3 x)
{
    return vec3(x.r > 0.0 ? min(x.r, MOST_DISPLAYABLE) : 0.0, x.g > 0.0 ? min(x.g, MOST_DISPLAYABLE) : 0.0,
        x.b > 0.0 ? min(x.b, MOST_DISPLAYABLE) : 0.0);
}

// A curve close to the ACES reference rendering and output transforms, for x >= 0.
// Source: Narkowicz 2016, "ACES Filmic Tone Mapping Curve". Divided through by x^2 above 1, so it cannot overflow.
vec3 aces_curve(vec3 x)
{
    const vec3 small = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
    const vec3 r = 1.0 / max(x, vec3(1.0));
    const vec3 large = (2.51 + 0.03 * r) / (2.43 + 0.59 * r + 0.14 * r * r);
    return clamp(mix(small, large, greaterThan(x, vec3(1.0))), 0.0, 1.0);
}

// What a screen is to show of scene-linear light, before sRGB encoding. `curve` 0: ACES-like, 1: none.
vec3 tone_curve(vec3 x, int curve)
{
    const vec3 light = displayable(x);
    return curve == 0 ? aces_curve(light) : min(light, vec3(1.0));
}

// Source: IEC 61966-2-1 (sRGB), for x in [0, 1].
vec3 srgb_encode(vec3 x)
{
    const vec3 curved = 1.055 * pow(max(x, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(curved, 12.92 * x, lessThanEqual(x, vec3(0.0031308)));
}
