// What a ray meets that leaves the scene.
#pragma once
#include "lib/frame.glsl"

// Radiance from where `direction` (unit) points to; black without environment.
vec3 environment_radiance(vec3 direction)
{
#ifdef FX_BACKGROUND
    return frame.background;
#else
    return vec3(0.0);
#endif
}

// The density with which sample_lights() finds `direction` on the environment, whatever the shading point. 0 for a
// constant environment: following the BSDF finds it as well as anything could, so it is not sampled as a light.
float environment_pdf(vec3 direction) { return 0.0; }
