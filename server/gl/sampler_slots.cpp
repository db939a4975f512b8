// One small program with a sampler in every slot.
#include "server/gl/sampler_slots.h"

#include "server/gl/program.h"
#include "server/gl/texture.h"

namespace farlight {

void settle_sampler_slots()
{
    GLint slots = 0;
    glGetIntegerv(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, &slots);
    ShaderSource source{"sampler slots", "#version 450\nlayout(local_size_x = 1) in;\n", {}};
    std::string sum = "vec4(0.0)";
    for (GLint i = 0; i < slots; ++i) {
        const std::string name = "slot_" + std::to_string(i);
        source.text += "uniform sampler2D " + name + ";\n";
        sum += " + texelFetch(" + name + ", ivec2(0), 0)";
    }
    source.text +=
        "uniform writeonly image2D out_sum;\nvoid main() { imageStore(out_sum, ivec2(0), " + sum
        + "); }\n";
    const Program program(source);
    const GpuTexture texel("sampler slots", GL_RGBA32F, {1, 1});
    const GpuTexture sum_texel("sum of sampler slots", GL_RGBA32F, {1, 1});
    glUseProgram(program.id());
    for (GLint i = 0; i < slots; ++i)
        glBindTextureUnit(static_cast<GLuint>(i), texel.id());
    glBindImageTexture(0, sum_texel.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA32F);
    glDispatchCompute(1, 1, 1);
    glFinish();
    glUseProgram(0);
}

}  // namespace farlight
