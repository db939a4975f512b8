// Puts the picture together, the exact inverse of the split into signals:
// transmittance of the fog * (albedo * (direct + indirect) + reflectance * specular + emission) + scattered.
//
//   in   in_direct, in_indirect, in_specular  rgba32f  demodulated radiance
//        in_scattered                         rgba32f  radiance
//        in_albedo, in_reflectance, in_emission, in_fog_way  G-buffer
//   LIT: there are signals; without, emission is all that is seen.
//   out  out_radiance                         rgba32f  scene-linear radiance
#version 450
#include "lib/frame.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_emission;
#ifdef LIT
uniform sampler2D in_direct;
uniform sampler2D in_indirect;
uniform sampler2D in_albedo;
#ifdef FX_FOG
uniform sampler2D in_scattered;
#endif
#endif
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D in_specular;
uniform sampler2D in_reflectance;
#endif
#ifdef FX_FOG
uniform sampler2D in_fog_way;
uniform vec3 fog_sigma_t;
#endif
uniform writeonly image2D out_radiance;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    precise vec3 radiance = texelFetch(in_emission, px, 0).rgb;
#ifdef LIT
    precise const vec3 light = texelFetch(in_direct, px, 0).rgb + texelFetch(in_indirect, px, 0).rgb;
    radiance += texelFetch(in_albedo, px, 0).rgb * light;
#endif
#ifdef FX_SPECULAR_SIGNAL
    const vec4 reflectance = texelFetch(in_reflectance, px, 0);
    if (reflectance.a >= 0.0)
        radiance += reflectance.rgb * texelFetch(in_specular, px, 0).rgb;
#endif
#ifdef FX_FOG
    if (max_component(fog_sigma_t) > 0.0)
        radiance *= exp(-fog_sigma_t * texelFetch(in_fog_way, px, 0).x);
#ifdef LIT
    radiance += texelFetch(in_scattered, px, 0).rgb;
#endif
#endif
    imageStore(out_radiance, px, vec4(counted_finite(radiance), 1.0));
}
