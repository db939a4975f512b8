// Where the light of fog was last frame.
#pragma once
#include "lib/frame.glsl"
#include "lib/numbers.glsl"

// Fog has no surface: what is one mean free path ahead, or on the surface before that, stands for the light.
// xy: previous minus current pixel [px]; w: 1, or 0 where that was behind the camera.
vec4 fog_motion(ivec2 px, float way, vec3 sigma_t)
{
    const vec3 direction = normalize(camera_direction(frame.camera, vec2(px) + 0.5));
    const vec3 position = frame.camera.position + direction * min(way, 1.0 / max_component(sigma_t));
    const vec3 now = camera_project(frame.camera, position);
    const vec3 before = camera_project(frame.prev_camera, position);
    return vec4(before.xy - now.xy, 0.0, before.z > 0.0 ? 1.0 : 0.0);
}
