// Warps from the unit square. Each samples exactly with the density its comment states.
// Source: Pharr et al. 2023, "Physically Based Rendering", 4th ed., appendix A.5 and chapter 6.
#pragma once
#include "lib/numbers.glsl"

// Density cos(theta) / pi per solid angle, z up.
vec3 sample_cosine_hemisphere(vec2 u)
{
    const float r = sqrt(u.x);
    const float phi = 2.0 * PI * u.y;
    return vec3(r * cos(phi), r * sin(phi), sqrt(max(0.0, 1.0 - u.x)));
}

// Uniform over the unit disk.
vec2 sample_disk(vec2 u)
{
    const float phi = 2.0 * PI * u.y;
    return sqrt(u.x) * vec2(cos(phi), sin(phi));
}

// Uniform directions within the cone around z whose opening is given by 1 - cos(theta_max).
vec3 sample_cone(vec2 u, float one_minus_cos_max)
{
    const float one_minus_cos = u.x * one_minus_cos_max;
    const float sin_theta = sqrt(max(0.0, one_minus_cos * (2.0 - one_minus_cos)));
    const float phi = 2.0 * PI * u.y;
    return vec3(sin_theta * cos(phi), sin_theta * sin(phi), 1.0 - one_minus_cos);
}

// Barycentric weights of the second and third vertex; uniform over the triangle.
vec2 sample_triangle(vec2 u)
{
    const float root = sqrt(u.x);
    return vec2(root * (1.0 - u.y), root * u.y);
}

// An orthonormal basis with n as its third column.
// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1).
mat3 basis_around(vec3 n)
{
    const float s = n.z >= 0.0 ? 1.0 : -1.0;
    const float a = -1.0 / (s + n.z);
    const float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// Weight of a sample from density p against one from q. The ratio form cannot overflow.
// Source: Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2.2 (beta = 2).
float power_heuristic(float p, float q)
{
    const float ratio = q / p;
    return p > 0.0 ? 1.0 / (1.0 + ratio * ratio) : 0.0;
}
