// One buffer behind the picture as numbers: what `raw` frames of a debug view hold.
//
//   in   in_texture  any      the buffer (VIEW_* says which and how it is read)
//   out  out_value   rgba32f  its value
//
//   VIEW_COLOR     rgb as it is           VIEW_VARIANCE   variance of in_texture plus that of in_second, thrice
//   VIEW_RED       r, thrice              VIEW_DEPTH      view depth [m], thrice
//   VIEW_GRADIENT  dz/dx, dz/dy, 0        VIEW_SHADING    shading normal
//   VIEW_OBJECT    object id              VIEW_MATERIAL   material id
//   VIEW_GEOMETRIC geometric normal       VIEW_POSITION   rgb from where the scene's file counts, 0 without a surface
//   VIEW_NOTHING   zero: the frame has no such buffer
#version 450
#include "lib/frame.glsl"
#include "lib/packing.glsl"
#include "svgf/noise.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

#if defined(VIEW_COLOR) || defined(VIEW_VARIANCE) || defined(VIEW_RED) || defined(VIEW_POSITION)
uniform sampler2D in_texture;
#elif !defined(VIEW_NOTHING)
uniform usampler2D in_texture;
#endif
#ifdef VIEW_VARIANCE
uniform sampler2D in_second;
#endif
#ifdef VIEW_POSITION
uniform vec3 origin;
#endif
uniform writeonly image2D out_value;

vec3 value_at(ivec2 px)
{
#if defined(VIEW_COLOR)
    return texelFetch(in_texture, px, 0).rgb;
#elif defined(VIEW_POSITION)
    const vec4 position = texelFetch(in_texture, px, 0);
    return position.a > 0.0 ? origin + position.rgb : vec3(0.0);
#elif defined(VIEW_NOTHING)
    return vec3(0.0);
#elif defined(VIEW_VARIANCE)
    return vec3(variance_in(texelFetch(in_texture, px, 0).a) + variance_in(texelFetch(in_second, px, 0).a));
#elif defined(VIEW_RED)
    return texelFetch(in_texture, px, 0).rrr;
#else
    const uvec4 bits = texelFetch(in_texture, px, 0);
#if defined(VIEW_DEPTH)
    return vec3(uintBitsToFloat(bits.x));
#elif defined(VIEW_GRADIENT)
    return vec3(uintBitsToFloat(bits.yz), 0.0);
#elif defined(VIEW_SHADING)
    return uintBitsToFloat(bits.x) > 0.0 ? unpack_octahedral(bits.w) : vec3(0.0);
#elif defined(VIEW_GEOMETRIC)
    return bits.w != 0u ? unpack_octahedral(bits.z) : vec3(0.0);
#elif defined(VIEW_OBJECT)
    return vec3(float(bits.x));
#elif defined(VIEW_MATERIAL)
    return vec3(float(bits.y));
#endif
#endif
}

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (inside_frame(px))
        imageStore(out_value, px, vec4(value_at(px), 1.0));
}
