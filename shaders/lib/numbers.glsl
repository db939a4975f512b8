// Constants and total tests on floating-point bits (isnan may be folded away by fast-math compilers).
#pragma once

const float PI = 3.14159265358979;
const float INV_PI = 0.318309886183791;

bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool all_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

// Whether all are finite and not negative, in bits; -0 stands for what is not known (lib/unknown.glsl) and is none.
bool is_light(vec3 v)
{
    const uvec3 bits = floatBitsToUint(v);
    return max(bits.x, max(bits.y, bits.z)) < 0x7f800000u;
}
bool is_light(vec4 v) { return max(floatBitsToUint(v.w), is_light(v.rgb) ? 0u : 0x7f800000u) < 0x7f800000u; }

float max_component(vec3 v) { return max(v.x, max(v.y, v.z)); }
float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }
