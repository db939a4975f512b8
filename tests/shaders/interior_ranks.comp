// A walk through nested and overlapping insides. Driven by bsdf_interior_test.cpp, whose steps say what is met: material,
// and 1 for its front. A texel a step: eta, whether the surface is real, absorption behind it once crossed, overflows.
#version 450
#include "bsdf/interior.glsl"

layout(local_size_x = 1) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer steps;

void main()
{
    Interior interior = outside_of_everything();
    for (int i = 0; i < textureSize(steps); ++i) {
        const uvec4 met = texelFetch(steps, i);
        const Inside inside = load_inside(met.x);
        ShadedMaterial m;
        m.ior = inside.ior;
        m.priority = inside.priority;
        m.transmission = 1.0;
        m.thin_walled = false;
        const Boundary boundary = boundary_at(interior, m, met.x, met.y != 0u);
        cross_boundary(interior, m, met.x, met.y != 0u);
        results[i] = vec4(boundary.eta, boundary.real ? 1.0 : 0.0, current_absorption(interior).x,
            float(interior.overflows));
    }
}
