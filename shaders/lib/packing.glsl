// Octahedral unit vectors in 32 bits.
// Source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", section 3.
#pragma once

uint pack_octahedral(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    const vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    p = n.z < 0.0 ? folded : p;
    return packSnorm2x16(p);
}

vec3 unpack_octahedral(uint bits)
{
    const vec2 p = unpackSnorm2x16(bits);
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    const float t = max(-n.z, 0.0);
    n.xy += vec2(n.x >= 0.0 ? -t : t, n.y >= 0.0 ? -t : t);
    return normalize(n);
}
