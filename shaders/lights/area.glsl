// Lights with an extent: points on them, the density of finding those per solid angle, and what they emit.
//
// Source: Pharr et al. 2023, "Physically Based Rendering", 4th ed., sections 6.2.4, 12.4 and appendix A.5.
#pragma once
#include "geometry/surface.glsl"
#include "lib/sampling.glsl"
#include "lights/light_sample.glsl"
#include "lights/light_table.glsl"
#include "lights/light_texture.glsl"

#ifdef FX_LIGHTS
// Density per solid angle of a point chosen uniformly over `area`; `way` leads to it.
float area_pdf(float area, vec3 way, vec3 normal)
{
    const float distance2 = dot(way, way);
    return distance2 * sqrt(distance2) / (area * abs(dot(normal, way)));
}

// The sample that ends at a point chosen uniformly over the light. Nothing, where the light is met or seen edge-on.
LightSample sample_point_of(Light light, vec3 position, vec3 point, vec3 normal, float offset)
{
    const vec3 way = point - position;
    const float pdf = area_pdf(light.area, way, normal);
    LightSample s = NO_LIGHT_SAMPLE;
    if (!(dot(way, way) > 0.0 && is_finite(pdf)))
        return s;
    s.position = point;
    s.normal = normal;
    s.offset = offset;
    s.wi = normalize(way);
    s.pdf = pdf;
    s.radiance = light.emits_both_sides || dot(normal, way) < 0.0 ? light.radiance : vec3(0.0);
    return s;
}

#ifdef FX_SPHERE_LIGHTS
// 1 - cos of the half angle under which a sphere is seen, from (radius / distance)^2, without cancellation.
float cone_opening(float sin2) { return sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2))); }

// From outside uniform over the visible cone, from inside over the area.
LightSample sample_sphere_light(Light light, vec3 position, vec2 u)
{
    const vec3 to_center = light.p0 - position;
    const float radius = light.edge_u.x;
    const float distance2 = dot(to_center, to_center);
    const float sin2 = radius * radius / distance2;
    const float offset = position_error(abs(light.p0) + radius);
    if (!(sin2 < 1.0)) {
        const vec3 normal = sample_cone(u, 2.0);
        return sample_point_of(light, position, light.p0 + radius * normal, normal, offset);
    }
    const float opening = cone_opening(sin2);
    const vec3 local = sample_cone(u, opening);
    LightSample s = NO_LIGHT_SAMPLE;
    s.wi = basis_around(to_center * inversesqrt(distance2)) * local;
    const float sin2_theta = local.x * local.x + local.y * local.y;
    const float along = local.z * sqrt(distance2);
    const float distance = along - sqrt(max(0.0, radius * radius - distance2 * sin2_theta));
    s.normal = normalize(position + distance * s.wi - light.p0);
    s.position = light.p0 + radius * s.normal;
    s.offset = offset;
    s.pdf = 1.0 / (2.0 * PI * opening);
    s.radiance = light.radiance;
    return s;
}

float sphere_light_pdf(Light light, vec3 position, vec3 hit_position)
{
    const vec3 to_center = light.p0 - position;
    const vec3 way = hit_position - position;
    const vec3 outward = hit_position - light.p0;
    const float sin2 = light.edge_u.x * light.edge_u.x / dot(to_center, to_center);
    if (!(sin2 < 1.0))
        return area_pdf(light.area, way, normalize(outward));
    // The far side is not sampled from outside; a ray may meet it where the near side lets it through.
    return dot(outward, way) < 0.0 ? 1.0 / (2.0 * PI * cone_opening(sin2)) : 0.0;
}
#endif

#ifdef FX_DISK_LIGHTS
LightSample sample_disk_light(Light light, vec3 position, vec2 u)
{
    const float r = light.edge_u.x * sqrt(u.x);
    const float phi = 2.0 * PI * u.y;
    const vec3 point = light.p0 + basis_around(light.edge_v) * vec3(r * cos(phi), r * sin(phi), 0.0);
    return sample_point_of(
        light, position, point, light.edge_v, position_error(abs(light.p0) + light.edge_u.x));
}
#endif

#if defined(FX_POLYGON_LIGHTS) || defined(FX_EMISSIVE_MESHES)
// `jitter` chooses the texel of a textured light.
LightSample sample_polygon_light(Light light, vec3 position, vec2 u, vec2 jitter)
{
    const vec2 st = light.kind == LIGHT_TRIANGLE ? sample_triangle(u) : u;
    const vec3 point = light.p0 + st.x * light.edge_u + st.y * light.edge_v;
    LightSample s = sample_point_of(light, position, point, normalize(cross(light.edge_u, light.edge_v)),
        position_error(abs(light.p0) + abs(light.edge_u) + abs(light.edge_v)));
    s.radiance *= light_texture(light, st, jitter);
    return s;
}
#endif

bool is_polygon(Light light) { return light.kind == LIGHT_QUAD || light.kind == LIGHT_TRIANGLE; }

// Of finding `hit_position` from `position`, given the light.
float area_light_pdf(Light light, vec3 position, vec3 hit_position, vec3 hit_normal)
{
    const float pdf = area_pdf(light.area, hit_position - position, hit_normal);
#ifdef FX_SPHERE_LIGHTS
    if (light.kind == LIGHT_SPHERE)
        return sphere_light_pdf(light, position, hit_position);
#endif
    return pdf;
}
#endif
