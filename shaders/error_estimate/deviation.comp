// The predicted standard deviation of each pixel, relative to the picture: the root of what predict.comp sums, over 7x7
// pixels, because a single pixel's half difference is one draw of its noise.
//
//   in   in_direct, in_indirect, in_specular, in_scattered  rgba32f  filtered light, noise a
//        in_picture                                         rgba32f  the filtered picture
//        and the G-buffer textures of composite/compose.glsl
//   out  out_deviation                                      r32f     [1]
#version 450
#include "error_estimate/noise_of_picture.glsl"
#include "error_estimate/relative.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D in_picture;
uniform writeonly image2D out_deviation;

const int RADIUS = 3;

void main()
{
    const ivec2 px = ivec2(gl_GlobalInvocationID.xy);
    if (!inside_frame(px))
        return;
    float sum = 0.0;
    float count = 0.0;
    for (int y = -RADIUS; y <= RADIUS; ++y)
        for (int x = -RADIUS; x <= RADIUS; ++x) {
            const ivec2 q = px + ivec2(x, y);
            if (inside_frame(q)) {
                Signals noise;
                filtered_light(q, noise);
                sum += relative_square(compose(q, vec3(0.0), noise), texelFetch(in_picture, q, 0).rgb);
                count += 1.0;
            }
        }
    imageStore(out_deviation, px, vec4(sqrt(sum / count)));
}
