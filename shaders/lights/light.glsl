// Sampling area lights with probability proportional to their power, and the density of doing so.
#pragma once
#include "geometry/surface.glsl"
#include "lib/sampling.glsl"

#ifdef FX_LIGHTS
uniform usamplerBuffer lights;

struct Light {
    uint kind;
    uint material;
    float pmf;
    float area;
    vec3 p0;
    float alias_threshold;
    vec3 edge_u;
    uint alias_index;
    vec3 edge_v;
};

Light load_light(uint index)
{
    const int at = int(index) * LIGHT_TEXELS;
    const uvec4 a = texelFetch(lights, at);
    const uvec4 b = texelFetch(lights, at + 1);
    const uvec4 c = texelFetch(lights, at + 2);
    const uvec4 d = texelFetch(lights, at + 3);
    return Light(a.x, a.y, uintBitsToFloat(a.z), uintBitsToFloat(a.w), uintBitsToFloat(b.xyz), uintBitsToFloat(b.w),
        uintBitsToFloat(c.xyz), c.w, uintBitsToFloat(d.xyz));
}

// A light with probability Light.pmf. Source: Vose 1991 (alias method).
Light choose_light(float u)
{
    const float scaled = u * float(LIGHT_COUNT);
    const uint slot = min(uint(scaled), LIGHT_COUNT - 1u);
    const Light light = load_light(slot);
    if (scaled - float(slot) < light.alias_threshold || light.alias_index == slot)
        return light;
    return load_light(light.alias_index);
}

struct LightSample {
    vec3 wi;          // unit, from the shading point to the light
    float pdf;        // per solid angle [1/sr], 0: nothing was sampled
    vec3 position;    // on the light [m]
    float cos_light;  // between the light's own normal and the way back; negative behind it
    vec3 normal;      // the light's own, unit
    float offset;     // how far off the light a ray to it must end [m]
};

const LightSample NO_LIGHT_SAMPLE
    = LightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 0.0, vec3(0.0, 0.0, 1.0), 0.0);

// 1 - cos of the half angle under which a sphere is seen, from (radius / distance)^2, without cancellation.
float cone_opening(float sin2) { return sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2))); }

#ifdef FX_SPHERE_LIGHTS
// Uniform over the visible cone. Source: Pharr et al. 2023, section 6.2.4. From inside nothing is seen.
LightSample sample_sphere_light(Light light, vec3 position, vec2 u)
{
    const vec3 to_center = light.p0 - position;
    const float radius = light.edge_u.x;
    const float distance2 = dot(to_center, to_center);
    const float sin2 = radius * radius / distance2;
    if (!(sin2 < 1.0))
        return NO_LIGHT_SAMPLE;
    const float opening = cone_opening(sin2);
    const vec3 local = sample_cone(u, opening);
    LightSample s;
    s.wi = basis_around(to_center * inversesqrt(distance2)) * local;
    const float sin2_theta = local.x * local.x + local.y * local.y;
    const float along = local.z * sqrt(distance2);
    const float distance = along - sqrt(max(0.0, radius * radius - distance2 * sin2_theta));
    s.normal = normalize(position + distance * s.wi - light.p0);
    s.position = light.p0 + radius * s.normal;
    s.offset = position_error(abs(light.p0) + radius);
    s.pdf = 1.0 / (2.0 * PI * opening);
    s.cos_light = 1.0;
    return s;
}
#endif

float area_to_solid_angle(float area, float distance, float cos_light)
{
    return distance * distance / (area * abs(cos_light));
}

LightSample sample_polygon_light(Light light, vec3 position, vec2 u)
{
    const vec2 st = light.kind == LIGHT_TRIANGLE ? sample_triangle(u) : u;
    LightSample s;
    s.position = light.p0 + st.x * light.edge_u + st.y * light.edge_v;
    s.normal = normalize(cross(light.edge_u, light.edge_v));
    s.offset = position_error(abs(light.p0) + abs(light.edge_u) + abs(light.edge_v));
    const vec3 v = s.position - position;
    const float distance = length(v);
    s.wi = v / distance;
    s.cos_light = -dot(s.normal, s.wi);
    s.pdf = area_to_solid_angle(light.area, distance, s.cos_light);
    if (!(distance > 0.0 && is_finite(s.pdf)))
        return NO_LIGHT_SAMPLE;
    return s;
}

LightSample sample_light(Light light, vec3 position, vec2 u)
{
#if defined(FX_SPHERE_LIGHTS) && defined(FX_POLYGON_LIGHTS)
    const LightSample polygon = sample_polygon_light(light, position, u);
    const LightSample sphere = sample_sphere_light(light, position, u);
    LightSample s = polygon;
    if (light.kind == LIGHT_SPHERE)
        s = sphere;
#elif defined(FX_SPHERE_LIGHTS)
    LightSample s = sample_sphere_light(light, position, u);
#else
    LightSample s = sample_polygon_light(light, position, u);
#endif
    s.pdf *= light.pmf;
    return s;
}

// The density with which sample_light() would have found this hit of light `index`, from `position`.
float light_pdf(uint index, vec3 position, float distance, float cos_light)
{
    const Light light = load_light(index);
    float pdf = area_to_solid_angle(light.area, distance, cos_light);
#ifdef FX_SPHERE_LIGHTS
    const vec3 to_center = light.p0 - position;
    const float sin2 = light.edge_u.x * light.edge_u.x / dot(to_center, to_center);
    if (light.kind == LIGHT_SPHERE)
        pdf = sin2 < 1.0 ? 1.0 / (2.0 * PI * cone_opening(sin2)) : 0.0;
#endif
    return light.pmf * pdf;
}
#endif

// Radiance leaving an emitter towards where it was seen from.
vec3 emitted(Material material, bool front)
{
    return front || material.emits_both_sides ? material.emission : vec3(0.0);
}
