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
    bool known = true;
#ifdef LIT
    const vec3 direct = texelFetch(in_direct, px, 0).rgb;
    const vec3 indirect = texelFetch(in_indirect, px, 0).rgb;
    light.diffuse = direct + indirect;
    known = counted_known(is_light(direct) && is_light(indirect), abs(direct) + abs(indirect));
#ifdef FX_FOG
    light.scattered = texelFetch(in_scattered, px, 0).rgb;
    known = counted_known(is_light(light.scattered), light.scattered) && known;
#endif
#endif
#ifdef FX_SPECULAR_SIGNAL
    light.specular = texelFetch(in_specular, px, 0).rgb;
    known = counted_known(is_light(light.specular), light.specular) && known;
#endif
    const vec3 radiance = compose(px, texelFetch(in_emission, px, 0).rgb, light);
    imageStore(out_radiance, px, vec4(known ? counted_light(radiance) : unknown_light(), 1.0));
}
