// The scene's fog. A pass sets the uniforms that its shader comes to use.
#pragma once
#include "media/fog.glsl"

uniform vec3 fog_sigma_t;
uniform vec3 fog_sigma_s;
uniform float fog_g;
uniform vec3 fog_center;
uniform float fog_radius;

Fog scene_fog() { return Fog(fog_sigma_t, fog_sigma_s, fog_g, fog_center, fog_radius); }

bool fog_present() { return max_component(fog_sigma_t) > 0.0; }
