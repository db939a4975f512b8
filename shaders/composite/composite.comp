// Puts the picture together.
//
//   in   in_direct, in_indirect, in_specular, in_scattered  rgba32f  light by signal
//        in_emission, and the G-buffer textures of composite/compose.glsl
//   out  out_radiance                                       rgba32f  scene-linear radiance
#version 450
#include "composite/compose.glsl"
#include "lib/counters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_emission;
#ifdef LIT
uniform sampler2D in_direct;
uniform sampler2D in_indirect;
#ifdef FX_FOG
uniform sampler2D in_scattered;
#endif
#endif
#ifdef FX_SPECULAR_SIGNAL
uniform sampler2D in_specular;
#endif
uniform writeonly image2D out_radiance;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    Signals light = Signals(vec3(0.0), vec3(0.0), vec3(0.0));
#ifdef LIT
    light.diffuse = texelFetch(in_direct, px, 0).rgb + texelFetch(in_indirect, px, 0).rgb;
#ifdef FX_FOG
    light.scattered = texelFetch(in_scattered, px, 0).rgb;
#endif
#endif
#ifdef FX_SPECULAR_SIGNAL
    light.specular = texelFetch(in_specular, px, 0).rgb;
#endif
    const vec3 radiance = compose(px, texelFetch(in_emission, px, 0).rgb, light);
    imageStore(out_radiance, px, vec4(counted_finite(radiance), 1.0));
}
