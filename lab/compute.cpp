// Binding, dispatch and reading back for shader tests.
#include "lab/compute.h"

#include "server/gl/buffer.h"
#include "server/gl/gl_error.h"

#include <fstream>
#include <sstream>

namespace farlight {

void add_shader_file(const std::string& name, const std::string& text)
{
    shader_files()[name] = text;
}

std::string read_text(const std::string& path)
{
    const std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::vector<glm::vec4> run_compute(
    const Program& program, const Inputs& inputs, std::size_t output_size, std::size_t invocations)
{
    std::vector<glm::vec4> values(output_size);
    const Buffer output("test output", std::as_bytes(std::span<const glm::vec4>(values)));
    glUseProgram(program.id());
    for (const auto& [name, texture] : inputs)
        if (const auto found = program.uniforms().find(name); found != program.uniforms().end())
            glBindTextureUnit(static_cast<GLuint>(found->second.unit), texture);
    glBindBufferBase(
        GL_SHADER_STORAGE_BUFFER, program.storage_blocks().at("output_block"), output.id());
    const auto group = static_cast<std::size_t>(program.work_group_size()[0]);
    glDispatchCompute(static_cast<GLuint>((invocations + group - 1) / group), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(
        output.id(), 0, static_cast<GLsizeiptr>(values.size() * sizeof(glm::vec4)), values.data());
    check_gl(program.name());
    return values;
}

}  // namespace farlight
