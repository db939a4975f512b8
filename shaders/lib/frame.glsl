// The frame's constants, and the camera as a map between pixels and world space.
#pragma once
#include "shared/frame_constants.h"

layout(std140) uniform frame_block { FrameConstants frame; };

// Unnormalised: the view depth along it grows by one a unit.
vec3 camera_direction(CameraConstants camera, vec2 pixel)
{
    const vec2 ndc = pixel / vec2(camera.width, camera.height) * 2.0 - 1.0;
    return camera.forward + ndc.x * camera.right - ndc.y * camera.up;
}

// Pixel coordinates and view depth of a world position. Meaningless unless the depth is > 0.
// `precise`: two calls with equal arguments give equal bits, whatever they are inlined into.
vec3 camera_project(CameraConstants camera, vec3 position_ws)
{
    precise const vec3 v = position_ws - camera.position;
    precise const float depth = dot(v, camera.forward);
    precise const vec2 ndc = vec2(dot(v, camera.right) / dot(camera.right, camera.right),
                         -dot(v, camera.up) / dot(camera.up, camera.up)) / depth;
    return vec3((ndc * 0.5 + 0.5) * vec2(camera.width, camera.height), depth);
}

bool inside_frame(ivec2 px) { return all(greaterThanEqual(px, ivec2(0))) && all(lessThan(px, ivec2(frame.extent))); }

// Of last frame's textures, which may have another size.
bool inside_prev_frame(ivec2 px)
{
    return all(greaterThanEqual(px, ivec2(0))) && all(lessThan(px, ivec2(frame.prev_camera.width, frame.prev_camera.height)));
}
