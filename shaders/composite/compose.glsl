// The picture from its signals, the exact inverse of the split into them:
// transmittance of the fog * (albedo * diffuse + reflectance * specular + emission) + scattered.
// LIT: there are signals; without, emission is all that is seen.
#pragma once
#include "lib/frame.glsl"
#include "lib/numbers.glsl"

#ifdef LIT
uniform sampler2D in_albedo;  // a: 1 on a surface
#endif
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D in_reflectance;
#endif
#ifdef FX_FOG
uniform sampler2D in_fog_way;
uniform vec3 fog_sigma_t;
#endif

// Light of a pixel by signal; what the scene lacks is not looked at.
struct Signals {
    vec3 diffuse;  // direct and indirect
    vec3 specular;
    vec3 scattered;
};

vec3 compose(ivec2 px, vec3 emission, Signals light)
{
    precise vec3 radiance = emission;
#ifdef LIT
    radiance += texelFetch(in_albedo, px, 0).rgb * light.diffuse;
#endif
#ifdef FX_SPECULAR_SIGNAL
    const vec4 reflectance = texelFetch(in_reflectance, px, 0);
    if (reflectance.a >= 0.0)
        radiance += reflectance.rgb * light.specular;
#endif
#ifdef FX_FOG
    if (max_component(fog_sigma_t) > 0.0)
        radiance *= exp(-fog_sigma_t * texelFetch(in_fog_way, px, 0).x);
#ifdef LIT
    radiance += light.scattered;
#endif
#endif
    return radiance;
}
