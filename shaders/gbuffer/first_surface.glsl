// The material that a primary ray meets: the same for the G-buffer and for the path that goes on from it.
#pragma once
#include "lib/frame.glsl"
#include "lights/lights.glsl"
#include "materials/material.glsl"
#include "bsdf/bsdf.glsl"
#include "bsdf/interior.glsl"

// Textures are filtered in full, because what they say becomes the factor between signals and picture.
ShadedMaterial first_material(Surface s, Ray ray)
{
    const float width = frame.camera.pixel_footprint * length(s.position - ray.origin);
    const TextureLookup lookup
        = TextureLookup(log2_cone_width(width, s.geometric_normal, ray.direction), false, vec3(0.0));
    return material_at(s, -ray.direction, lookup);
}

bool scatters(ShadedMaterial m)
{
#ifdef FX_UNLIT
    return !m.unlit;
#else
    return true;
#endif
}

// What the diffuse signals are divided by.
vec3 diffuse_albedo(ShadedMaterial m, Surface s, Ray ray)
{
    return scatters(m) ? make_bsdf(m, s.geometric_normal, -ray.direction, opaque_eta(m)).albedo : vec3(0.0);
}
