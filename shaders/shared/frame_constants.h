// FrameConstants: what every pass may know about the current frame. Bound as uniform block
// `frame_block`. Written once a frame by View::render(); read-only in shaders.
#pragma once
#include "shared/host_device.h"

SHARED_BEGIN

// A pinhole camera as the frame of its rays: pixel (x, y) looks along
// forward + ndc.x * right - ndc.y * up, with ndc in [-1, 1] from the picture's top left.
struct CameraConstants {
    vec3 position;  // in world space, counted from the scene's origin like all there [m]
    float pixel_footprint;  // height of a pixel at view depth 1 [m]
    vec3 forward;  // unit
    float width;  // of the picture it draws [px]
    vec3 right;  // half the picture's width at view depth 1
    float height;  // [px]
    vec3 up;  // half the picture's height at view depth 1
    float pad0;
};

struct FrameConstants {
    CameraConstants camera;
    CameraConstants prev_camera;  // last frame's, perhaps of another size; equals camera when there
                                  // was none

    vec3 background;  // radiance of a ray that leaves the scene [W/(m^2 sr)]
    uint first_sample;  // samples a pixel since the view was cut; with seed the source of all
                        // randomness

    uvec2 extent;  // render resolution [px]
    uint seed;
    uint light_count;  // that can be chosen; 0: a scene without, in a program with

    uvec4 camera_inside;  // what the camera is inside of: materials + 1, oldest first, 0: nothing more

    vec3 camera_absorption;  // of what fills the place around the camera [1/m]
    uint frame_index;  // frames since the view was cut
};

SHARED_END
