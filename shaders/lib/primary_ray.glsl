// The ray that looks through a pixel, the same for every pass that asks.
//
// Thin lens: rays from all over the aperture meet where the pixel's ray crosses the plane of focus.
// Source: Kolb, Mitchell, Hanrahan 1995, "A Realistic Camera Model for Computer Graphics", section 3.1.
#pragma once
#include "geometry/ray.glsl"
#include "lib/frame.glsl"
#include "lib/random.glsl"
#include "lib/sampling.glsl"

#ifdef FX_LENS
uniform float lens_radius;     // [m], 0: pinhole
uniform float focus_distance;  // view depth that is sharp [m]
#endif
#ifdef FX_ANTIALIASING
uniform vec2 pixel_jitter;  // from the pixel's middle [px]
#endif

struct PrimaryRay {
    vec3 origin;
    vec3 direction;  // unnormalised: the view depth along it grows by one a unit
};

PrimaryRay primary_ray(ivec2 px)
{
    precise vec2 pixel = vec2(px) + 0.5;
#ifdef FX_ANTIALIASING
    pixel += pixel_jitter;
#endif
    precise vec3 origin = frame.camera.position;
    precise vec3 direction = camera_direction(frame.camera, pixel);
#ifdef FX_LENS
    if (lens_radius > 0.0) {
        const vec2 u = random4(uvec2(px), frame.seed, frame.first_sample, 0u, SLOT_LENS).xy;
        const vec2 on_lens = lens_radius * sample_disk(u);
        const vec3 aside = on_lens.x * normalize(frame.camera.right) + on_lens.y * normalize(frame.camera.up);
        origin += aside;
        direction -= aside / focus_distance;
    }
#endif
    return PrimaryRay(origin, direction);
}

Ray ray_of(PrimaryRay r) { return Ray(r.origin, normalize(r.direction)); }
