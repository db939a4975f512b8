// Random numbers as a function of (pixel, sample, bounce, slot): no state, so an absent effect shifts nothing.
//
// Source: Jarzynski and Olano 2020, "Hash Functions for GPU Rendering", JCGT 9(3): pcg4d.
#pragma once

// What a number decides. Four numbers a slot.
const uint SLOT_LIGHT = 0u;  // which light, where on it
const uint SLOT_BSDF = 1u;   // direction (xy), Russian roulette (z), lobe (w)
const uint SLOT_LENS = 2u;   // point on the aperture (xy)
const uint SLOT_FOG = 3u;    // distance (xy)
const uint SLOT_TEXTURE = 4u;  // texel (xyz)
const uint SLOT_COVERAGE = 5u;  // whether a blend stops the ray that scattering sends on, with the primitive's number
const uint SLOT_SHADOW_COVERAGE = 6u;  // likewise, the ray to a light
const uint SLOTS = 8u;

// The bounce of rays from the camera, beyond any other.
const uint PRIMARY_BOUNCE = 255u;

// Bounces of a path that starts in the fog before the first surface count from here, above any path's from there.
const uint FOG_PATH_BOUNCE = 64u;

uvec4 pcg4d(uvec4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// What the four numbers of a slot are hashed from. `sample_index` counts a pixel's samples over all frames.
uvec4 random_key(uvec2 px, uint seed, uint sample_index, uint bounce, uint slot)
{
    return uvec4(px.x, px.y ^ (seed * 0x9e3779b9u), sample_index, bounce * SLOTS + slot);
}

// Four independent uniform numbers in [0, 1).
vec4 random4(uvec2 px, uint seed, uint sample_index, uint bounce, uint slot)
{
    return vec4(pcg4d(random_key(px, seed, sample_index, bounce, slot)) >> 8u) * exp2(-24.0);
}
