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

// Part of the light that is left after `way` [m] through what is around the camera.
vec3 left_of_first_segment(float way)
{
#ifdef FX_DIELECTRIC
    if (max_component(frame.camera_absorption) > 0.0)
        return exp(-frame.camera_absorption * way);
#endif
    return vec3(1.0);
}

// Fog fills what nothing else does.
bool camera_in_the_open()
{
#ifdef FX_DIELECTRIC
    return frame.camera_inside == uvec4(0u);
#else
    return true;
#endif
}

#ifdef FX_DIELECTRIC
Interior around_camera() { return Interior(frame.camera_inside, 0u); }
#endif

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
