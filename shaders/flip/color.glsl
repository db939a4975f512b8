// Colours of FLIP, all relative to the white of the screen (sRGB primaries, D65).
// Source: Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images", section 4.1. A test holds
// this and shaders/flip/ together with client/metrics/flip*.cpp.
#pragma once

// Exact fractions of the primaries and the white of sRGB, each row by its sum.
const vec3 X_OF_RGB = vec3(10135552.0, 8788810.0, 4435075.0) / 23359437.0;
const vec3 Y_OF_RGB = vec3(2613072.0, 8788810.0, 887015.0) / 12288897.0;
const vec3 Z_OF_RGB = vec3(1425312.0, 8788810.0, 70074185.0) / 80288307.0;

vec3 xyz_of_rgb(vec3 rgb) { return vec3(dot(X_OF_RGB, rgb), dot(Y_OF_RGB, rgb), dot(Z_OF_RGB, rgb)); }
vec3 rgb_of_xyz(vec3 xyz) { return xyz * inverse(mat3(X_OF_RGB, Y_OF_RGB, Z_OF_RGB)); }

// Brightness, red against green, blue against yellow: YCxCz without the scales and the offset, which filters keep.
vec3 opponent_of_rgb(vec3 rgb)
{
    const vec3 xyz = xyz_of_rgb(rgb);
    return vec3(xyz.y, xyz.x - xyz.y, xyz.y - xyz.z);
}

// The inverse, as far as a screen can show it.
vec3 rgb_of_opponent(vec3 c) { return clamp(rgb_of_xyz(vec3(c.x + c.y, c.x, c.x - c.z)), 0.0, 1.0); }

// CIE 15:2004, equation 8.
float lab_curve(float t)
{
    const float delta = 6.0 / 29.0;
    return t > delta * delta * delta ? pow(t, 1.0 / 3.0) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

// CIELAB with chroma scaled by lightness (Hunt effect).
vec3 hunt_lab_of_rgb(vec3 rgb)
{
    const vec3 xyz = xyz_of_rgb(rgb);
    const vec3 f = vec3(lab_curve(xyz.x), lab_curve(xyz.y), lab_curve(xyz.z));
    const float lightness = 116.0 * f.y - 16.0;
    return vec3(lightness, 0.01 * lightness * vec2(500.0, 200.0) * (f.xy - f.yz));
}

// Source: Abasi, Tehran, Fairchild 2020, "Distance Metrics for Very Large Color Differences"; to the power of q_c.
float powered_distance(vec3 lab_a, vec3 lab_b)
{
    const vec3 d = lab_a - lab_b;
    const float hyab = abs(d.x) + length(d.yz);
    return hyab > 0.0 ? pow(hyab, 0.7) : 0.0;
}

// Section 4.1.3: the distance of green and blue, the largest, becomes 1; 0.4 of it (p_c) becomes 0.95 (p_t).
float color_difference(vec3 lab_test, vec3 lab_reference)
{
    const float largest =
        powered_distance(hunt_lab_of_rgb(vec3(0.0, 1.0, 0.0)), hunt_lab_of_rgb(vec3(0.0, 0.0, 1.0)));
    const float knee = 0.4 * largest;
    const float d = powered_distance(lab_test, lab_reference);
    return d < knee ? 0.95 / knee * d : 0.95 + (d - knee) / (largest - knee) * 0.05;
}
