// Puts the picture together.
//
//   in   in_direct, in_indirect, in_specular, in_scattered  rgba32f  light by signal
//        in_emission, and the G-buffer textures of composite/compose.glsl
//   out  out_radiance                                       rgba32f  scene-linear radiance
#version 450
#include "composite/compose.glsl"
#include "lib/unknown.glsl"

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
    const vec3 emission = texelFetch(in_emission, px, 0).rgb;
    bool known = counted_known(STAGE_COMPOSITE, emission);
#ifdef LIT
    const vec3 direct = texelFetch(in_direct, px, 0).rgb;
    const vec3 indirect = texelFetch(in_indirect, px, 0).rgb;
    light.diffuse = direct + indirect;
    note(STAGE_COMPOSITE, kinds_in(direct, indirect));
    known = known && is_light(direct) && is_light(indirect);
#ifdef FX_FOG
    light.scattered = texelFetch(in_scattered, px, 0).rgb;
    known = counted_known(STAGE_COMPOSITE, light.scattered) && known;
#endif
#endif
#ifdef FX_SPECULAR_SIGNAL
    light.specular = texelFetch(in_specular, px, 0).rgb;
    known = counted_known(STAGE_COMPOSITE, light.specular) && known;
#endif
    vec3 radiance = unknown_light();
    if (known)
        radiance = counted_light(STAGE_COMPOSITE, compose(px, emission, light));
    imageStore(out_radiance, px, vec4(radiance, 1.0));
    tell_noted(px, STAGE_COMPOSITE);
}
