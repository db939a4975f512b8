// Where a pixel's light was last frame, by kind of signal (svgf/signal.glsl names them), and whether it is the same.
#pragma once
#include "svgf/fog_motion.glsl"
#include "svgf/surface.glsl"

// What has to be found again, and around which pixel of last frame.
struct Past {
    bool exists;
    vec2 pixel;
    vec3 position;  // where the surface was last frame [m]
    vec3 geometric_normal;
    vec3 shading_normal;
    uvec2 ids;
    float tolerance;  // distance from the surface's plane [m]; in fog of transmittance
    float key;        // specular: roughness (GGX alpha); scattered: the fog's transmittance
};

// lit(px): whether light of the kind reaches the pixel at all. Only what is lit and was lit has a history, so
// that what is drawn does not depend on whether the programs of last frame knew the kind.

#ifdef SIGNAL_SCATTERED

uniform sampler2D in_fog_way;
uniform sampler2D prev_fog_way;
uniform vec3 fog_sigma_t;

float transmittance(float way) { return luminance(exp(-fog_sigma_t * way)); }

Past past_of(ivec2 px)
{
    const float way = texelFetch(in_fog_way, px, 0).x;
    const vec4 motion = fog_motion(px, way, fog_sigma_t);
    Past p;
    p.exists = motion.w > 0.0;
    p.pixel = vec2(px) + 0.5 + motion.xy;
    p.key = transmittance(way);
    p.tolerance = 0.1;  // of 1: twice what the filter lets through, because fog changes slowly
    return p;
}

bool consistent(Past p, ivec2 q)
{
    return inside_prev_frame(q) && abs(transmittance(texelFetch(prev_fog_way, q, 0).x) - p.key) <= p.tolerance;
}

bool lit(ivec2 px) { return max_component(fog_sigma_t) * texelFetch(in_fog_way, px, 0).x > 0.0; }

#else

uniform usampler2D in_surface;
uniform usampler2D in_identity;
uniform sampler2D in_motion;
uniform usampler2D prev_surface;
uniform usampler2D prev_identity;
uniform float reproject_depth;   // tolerated distance from the surface's plane [pixel footprints]
uniform float reproject_normal;  // least cosine between the normals

Past past_of_surface(ivec2 px)
{
    const uvec4 surface = texelFetch(in_surface, px, 0);
    const uvec4 identity = texelFetch(in_identity, px, 0);
    const vec4 motion = texelFetch(in_motion, px, 0);
    const float depth = uintBitsToFloat(surface.x);
    Past p;
    p.exists = motion.w > 0.0;
    p.pixel = vec2(px) + 0.5 + motion.xy;
    p.position = frame.prev_camera.position + (depth + motion.z) * camera_direction(frame.prev_camera, p.pixel);
    p.geometric_normal = unpack_octahedral(identity.z);
    p.shading_normal = unpack_octahedral(surface.w);
    p.ids = identity.xy;
    p.tolerance = reproject_depth * frame.prev_camera.pixel_footprint * (depth + motion.z);
#ifdef FX_LENS
    if (lens_radius > 0.0)
        p.tolerance *= 1.0 + circle_of_confusion(depth);
#endif
    p.key = 0.0;
    return p;
}

// Whether last frame's pixel q shows the same piece of surface. Written as accept-if: a NaN anywhere rejects.
bool consistent(Past p, ivec2 q)
{
    if (!inside_prev_frame(q))
        return false;
    const uvec4 identity = texelFetch(prev_identity, q, 0);
    const uvec4 surface = texelFetch(prev_surface, q, 0);
    const vec3 position = frame.prev_camera.position
        + uintBitsToFloat(surface.x) * camera_direction(frame.prev_camera, vec2(q) + 0.5);
    const float plane_distance = abs(dot(p.geometric_normal, position - p.position));
    return identity.w != 0u && identity.xy == p.ids && plane_distance <= p.tolerance
        && dot(unpack_octahedral(surface.w), p.shading_normal) >= reproject_normal;
}

#ifdef SIGNAL_SPECULAR

uniform sampler2D in_light;
uniform sampler2D in_position;
uniform sampler2D in_reflectance;  // a: GGX alpha, negative where nothing is specular

// How far away what is mirrored lies, from the neighbourhood: the pixel's own sample may have missed the lobe.
// The nearest, because that is what a wrong reprojection would smear most.
float reflected_distance(ivec2 px)
{
    float nearest = 0.0;
    for (int i = 0; i < 9; ++i) {
        const vec4 sample_there = texelFetch(in_light, px + ivec2(i % 3, i / 3) - 1, 0);
        const float found = is_light(sample_there) ? sample_there.a : 0.0;
        nearest = found > 0.0 && (nearest == 0.0 || found < nearest) ? found : nearest;
    }
    return nearest;
}

// Mean curvature of the surface [1/m], positive where it bulges: how much its normal turns towards the neighbours.
float curvature(ivec2 px, vec3 position, Past p)
{
    float sum = 0.0;
    float count = 0.0;
    for (int i = 0; i < 4; ++i) {
        const ivec2 q = px + (ivec2(i & 1, i >> 1) * 2 - 1);
        const vec3 way = texelFetch(in_position, q, 0).xyz - position;
        const vec3 turn = unpack_octahedral(texelFetch(in_surface, q, 0).w) - p.shading_normal;
        const bool same = inside_frame(q) && texelFetch(in_identity, q, 0).xy == p.ids && dot(way, way) > 0.0
            && dot(turn, turn) <= 0.25;
        sum += same ? dot(turn, way) / dot(way, way) : 0.0;
        count += same ? 1.0 : 0.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

// What a mirror shows moves like its virtual image, which lies behind the surface by the distance of what is mirrored;
// a bulging mirror draws it nearer (thin lens). What a rough surface shows moves with the surface.
Past past_of(ivec2 px)
{
    Past p = past_of_surface(px);
    const float alpha = texelFetch(in_reflectance, px, 0).a;
    p.key = alpha;
    const vec3 position = texelFetch(in_position, px, 0).xyz;
    const float distance = reflected_distance(px);
    const float bent = 1.0 + 2.0 * curvature(px, position, p) * distance;
    // A hollow mirror beyond its focus turns the image over: there the surface is as good a guess.
    const float image = bent > 0.05 ? distance / bent : 0.0;
    const vec3 away = position - frame.camera.position;
    // From alpha 0.05 on the lobe begins to show more than one thing, at 0.25 nothing in it has an edge.
    const vec3 push = normalize(away) * image * (1.0 - smoothstep(0.05, 0.25, alpha));
    const vec3 now = camera_project(frame.camera, position + push);
    const vec2 still = texelFetch(in_motion, px, 0).xy;
    // Motion of the virtual image seen by the two cameras, and what the surface itself has moved.
    const vec3 before = camera_project(frame.prev_camera, position + push);
    const vec2 camera_of_surface
        = camera_project(frame.prev_camera, position).xy - camera_project(frame.camera, position).xy;
    p.pixel = vec2(px) + 0.5 + (before.xy - now.xy) + (still - camera_of_surface);
    p.exists = p.exists && before.z > 0.0;
    return p;
}

bool lit(ivec2 px) { return texelFetch(in_reflectance, px, 0).a >= 0.0; }

#else

Past past_of(ivec2 px) { return past_of_surface(px); }
bool lit(ivec2 px) { return texelFetch(in_identity, px, 0).w != 0u; }

#endif
#endif
