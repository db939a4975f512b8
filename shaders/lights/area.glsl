// Lights with an extent: points on them, the density of finding those per solid angle, and what they emit.
//
// Source: Pharr et al. 2023, "Physically Based Rendering", 4th ed., sections 6.2.4 and 12.4.
#pragma once
#include "geometry/surface.glsl"
#include "lib/sampling.glsl"
#include "lights/light_sample.glsl"
#include "lights/light_table.glsl"

#ifdef FX_LIGHTS
// 1 - cos of the half angle under which a sphere is seen, from (radius / distance)^2, without cancellation.
float cone_opening(float sin2) { return sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2))); }

#ifdef FX_SPHERE_LIGHTS
// Uniform over the visible cone. From inside nothing is seen.
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
    LightSample s = NO_LIGHT_SAMPLE;
    s.wi = basis_around(to_center * inversesqrt(distance2)) * local;
    const float sin2_theta = local.x * local.x + local.y * local.y;
    const float along = local.z * sqrt(distance2);
    const float distance = along - sqrt(max(0.0, radius * radius - distance2 * sin2_theta));
    s.normal = normalize(position + distance * s.wi - light.p0);
    s.position = light.p0 + radius * s.normal;
    s.offset = position_error(abs(light.p0) + radius);
    s.pdf = 1.0 / (2.0 * PI * opening);
    s.radiance = light.radiance;
    return s;
}
#endif

// Density per solid angle of a point chosen uniformly over `area`; `way` leads to it.
float area_pdf(float area, vec3 way, vec3 normal)
{
    const float distance2 = dot(way, way);
    return distance2 * sqrt(distance2) / (area * abs(dot(normal, way)));
}

LightSample sample_polygon_light(Light light, vec3 position, vec2 u)
{
    const vec2 st = light.kind == LIGHT_TRIANGLE ? sample_triangle(u) : u;
    LightSample s = NO_LIGHT_SAMPLE;
    s.position = light.p0 + st.x * light.edge_u + st.y * light.edge_v;
    s.normal = normalize(cross(light.edge_u, light.edge_v));
    s.offset = position_error(abs(light.p0) + abs(light.edge_u) + abs(light.edge_v));
    const vec3 way = s.position - position;
    s.wi = normalize(way);
    s.pdf = area_pdf(light.area, way, s.normal);
    s.radiance = light.emits_both_sides || dot(s.normal, way) < 0.0 ? light.radiance : vec3(0.0);
    if (!(dot(way, way) > 0.0 && is_finite(s.pdf)))
        return NO_LIGHT_SAMPLE;
    return s;
}

LightSample sample_area_light(Light light, vec3 position, vec2 u)
{
#if defined(FX_SPHERE_LIGHTS) && defined(FX_POLYGON_LIGHTS)
    const LightSample polygon = sample_polygon_light(light, position, u);
    const LightSample sphere = sample_sphere_light(light, position, u);
    LightSample s = polygon;
    if (light.kind == LIGHT_SPHERE)
        s = sphere;
    return s;
#elif defined(FX_SPHERE_LIGHTS)
    return sample_sphere_light(light, position, u);
#else
    return sample_polygon_light(light, position, u);
#endif
}

// Of finding `hit_position` from `position`, given the light.
float area_light_pdf(Light light, vec3 position, vec3 hit_position, vec3 hit_normal)
{
    float pdf = area_pdf(light.area, hit_position - position, hit_normal);
#ifdef FX_SPHERE_LIGHTS
    const vec3 to_center = light.p0 - position;
    const float sin2 = light.edge_u.x * light.edge_u.x / dot(to_center, to_center);
    if (light.kind == LIGHT_SPHERE)
        pdf = sin2 < 1.0 ? 1.0 / (2.0 * PI * cone_opening(sin2)) : 0.0;
#endif
    return pdf;
}
#endif
