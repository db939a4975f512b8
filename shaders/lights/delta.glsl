// Lights without extent: point, spot, directional. They are met by sampling alone.
//
// Source: KHR_lights_punctual (Khronos glTF extension), "Inner and Outer Cone Angles".
#pragma once
#include "lights/light_sample.glsl"
#include "lights/light_table.glsl"
#include "lib/numbers.glsl"

#if defined(FX_LIGHTS) && defined(FX_DELTA_LIGHTS)
bool is_delta(Light light) { return light.kind >= LIGHT_POINT && light.kind <= LIGHT_DIRECTIONAL; }

// Part of a spot's intensity that goes along the unit `way`.
float spot_falloff(Light light, vec3 way)
{
    const float x = clamp(dot(light.edge_v, way) * light.edge_u.x + light.edge_u.y, 0.0, 1.0);
    return x * x;
}

LightSample sample_delta_light(Light light, vec3 position)
{
    const vec3 way = light.p0 - position;
    const float distance2 = dot(way, way);
    LightSample s = NO_LIGHT_SAMPLE;
    s.delta = true;
    s.infinite = light.kind == LIGHT_DIRECTIONAL;
    s.wi = s.infinite ? -light.edge_v : normalize(way);
    s.position = light.p0;
    s.normal = vec3(0.0);
    s.radiance = light.radiance;
    if (!s.infinite)
        s.radiance /= distance2;
    if (light.kind == LIGHT_SPOT)
        s.radiance *= spot_falloff(light, -s.wi);
    s.pdf = s.infinite || (distance2 > 0.0 && all_finite(s.radiance)) ? 1.0 : 0.0;
    return s;
}
#endif
