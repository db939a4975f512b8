// See the header.
#include "lab/pass_bench.h"

#include "server/gl/gl_error.h"

#include <cassert>
#include <stdexcept>

namespace farlight::lab {
namespace {

template <typename T> std::span<const std::byte> bytes_of(const T& object)
{
    return std::as_bytes(std::span<const T, 1>(&object, 1));
}

shared::FrameConstants frame_at_rest(Extent extent)
{
    shared::FrameConstants frame{};
    const auto width = static_cast<float>(extent.width);
    const auto height = static_cast<float>(extent.height);
    frame.camera.pixel_footprint = 2 / height;
    frame.camera.forward = {0, 0, -1};
    frame.camera.right = {width / height, 0, 0};
    frame.camera.up = {0, 1, 0};
    frame.camera.width = width;
    frame.camera.height = height;
    frame.prev_camera = frame.camera;
    frame.extent = {extent.width, extent.height};
    return frame;
}

}  // namespace

PassBench::PassBench(const std::string& shader, const Defines& defines, Extent extent)
    : program_(load_shader_source(shader, defines))
    , extent_(extent)
    , frame_(frame_at_rest(extent))
    , frame_block_("bench frame", bytes_of(frame_))
    , counters_("bench counters", bytes_of(BadValues::Counts{}))
    , tiles_("bench tiles",
          std::vector<std::byte>(sizeof(glm::vec4) * static_cast<std::size_t>(extent.width)
              * static_cast<std::size_t>(extent.height)))
{
}

void PassBench::fill(const std::string& name, GLenum format, const glm::vec4& value)
{
    auto texture = std::make_shared<GpuTexture>("bench " + name, format, extent_);
    glClearTexImage(texture->id(), 0, GL_RGBA, GL_FLOAT, &value);
    textures_[name] = std::move(texture);
}

void PassBench::set_pixel(const std::string& name, int x, int y, const glm::vec4& value)
{
    glTextureSubImage2D(textures_.at(name)->id(), 0, x, y, 1, 1, GL_RGBA, GL_FLOAT, &value);
}

void PassBench::set_texels(const std::string& name, const std::vector<glm::vec4>& texels)
{
    assert(texels.size()
        == static_cast<std::size_t>(extent_.width) * static_cast<std::size_t>(extent_.height));
    glTextureSubImage2D(textures_.at(name)->id(), 0, 0, 0, extent_.width, extent_.height, GL_RGBA,
        GL_FLOAT, texels.data());
}

void PassBench::share(
    const std::string& name, const PassBench& other, const std::string& others_name)
{
    assert(extent_ == other.extent_);
    textures_[name] = other.textures_.at(others_name);
}

void PassBench::fill_bits(const std::string& name, GLenum format, const glm::uvec4& value)
{
    auto texture = std::make_shared<GpuTexture>("bench " + name, format, extent_);
    glClearTexImage(texture->id(), 0, GL_RGBA_INTEGER, GL_UNSIGNED_INT, &value);
    textures_[name] = std::move(texture);
}

void PassBench::set_bits(const std::string& name, int x, int y, const glm::uvec4& value)
{
    glTextureSubImage2D(
        textures_.at(name)->id(), 0, x, y, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_INT, &value);
}

void PassBench::swap(const std::string& a, const std::string& b)
{
    std::swap(textures_.at(a), textures_.at(b));
}

void PassBench::constant(const std::string& name, std::variant<int, float, glm::vec3> value)
{
    const GLint location = program_.uniforms().at(name).location;
    const GLuint program = program_.id();
    if (const int* whole = std::get_if<int>(&value))
        glProgramUniform1i(program, location, *whole);
    else if (const float* real = std::get_if<float>(&value))
        glProgramUniform1f(program, location, *real);
    else
        glProgramUniform3fv(program, location, 1, &std::get<glm::vec3>(value).x);
}

void PassBench::bind() const
{
    for (const auto& [name, variable] : program_.uniforms()) {
        const VariableKind kind = kind_of(variable.type);
        if (kind == VariableKind::kConstant)
            continue;
        const auto found = textures_.find(name);
        if (found == textures_.end())
            throw std::runtime_error(program_.name() + ": nobody made " + name);
        const auto unit = static_cast<GLuint>(variable.unit);
        if (kind == VariableKind::kSampler)
            glBindTextureUnit(unit, found->second->id());
        else
            glBindImageTexture(
                unit, found->second->id(), 0, GL_FALSE, 0, GL_READ_WRITE, found->second->format());
    }
    const auto bind_block = [&](GLenum target, const auto& blocks, const char* name,
                                const Buffer& buffer) {
        if (const auto found = blocks.find(name); found != blocks.end())
            glBindBufferBase(target, found->second, buffer.id());
    };
    bind_block(GL_UNIFORM_BUFFER, program_.uniform_blocks(), "frame_block", frame_block_);
    bind_block(GL_SHADER_STORAGE_BUFFER, program_.storage_blocks(), "counter_block", counters_);
    bind_block(GL_SHADER_STORAGE_BUFFER, program_.storage_blocks(), "tile_block", tiles_);
}

void PassBench::run()
{
    frame_block_.update(bytes_of(frame_));
    glUseProgram(program_.id());
    bind();
    const GLint* group = program_.work_group_size();
    glDispatchCompute(static_cast<GLuint>((extent_.width + group[0] - 1) / group[0]),
        static_cast<GLuint>((extent_.height + group[1] - 1) / group[1]), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT
        | GL_TEXTURE_UPDATE_BARRIER_BIT);
    check_gl(program_.name());
}

std::vector<glm::vec4> PassBench::read(const std::string& name) const
{
    std::vector<glm::vec4> texels(
        static_cast<std::size_t>(extent_.width) * static_cast<std::size_t>(extent_.height));
    glGetTextureImage(textures_.at(name)->id(), 0, GL_RGBA, GL_FLOAT,
        static_cast<GLsizei>(texels.size() * sizeof(glm::vec4)), texels.data());
    return texels;
}

BadValues PassBench::bad_values() const
{
    BadValues values;
    glGetNamedBufferSubData(counters_.id(), 0, sizeof values.counts(), values.counts().data());
    return values;
}

}  // namespace farlight::lab
