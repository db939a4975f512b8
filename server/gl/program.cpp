// Compiling, linking, and asking the driver what the program uses.
#include "server/gl/program.h"

#include "server/gl/gl_error.h"
#include "server/gl/program_binaries.h"

#include <memory>

namespace farlight {
namespace {

/// What the driver says of a shader or a program: the two take different functions for the same
/// thing.
template <typename GetInteger, typename GetLog>
std::string info_log(GLuint object, GetInteger get_integer, GetLog get_log)
{
    GLint length = 0;
    get_integer(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    get_log(object, length, nullptr, log.data());
    return log.c_str();
}

std::string resource_name(GLuint program, GLenum interface, GLuint index)
{
    char name[256];
    GLsizei length = 0;
    glGetProgramResourceName(program, interface, index, sizeof name, &length, name);
    return {name, static_cast<std::size_t>(length)};
}

GLuint compiled(const ShaderSource& source)
{
    const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE)
        return shader;
    const std::string log = info_log(shader, glGetShaderiv, glGetShaderInfoLog);
    glDeleteShader(shader);
    throw ShaderError("cannot compile " + explain_log(source, log));
}

bool linked(GLuint program)
{
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    return ok == GL_TRUE;
}

}  // namespace

VariableKind kind_of(GLenum uniform_type)
{
    switch (uniform_type) {
    case GL_SAMPLER_2D:
    case GL_SAMPLER_2D_ARRAY:
    case GL_INT_SAMPLER_2D:
    case GL_UNSIGNED_INT_SAMPLER_2D:
    case GL_SAMPLER_BUFFER:
    case GL_INT_SAMPLER_BUFFER:
    case GL_UNSIGNED_INT_SAMPLER_BUFFER: return VariableKind::kSampler;
    case GL_IMAGE_2D:
    case GL_INT_IMAGE_2D:
    case GL_UNSIGNED_INT_IMAGE_2D: return VariableKind::kImage;
    default: return VariableKind::kConstant;
    }
}

Program::Program(const ShaderSource& source, const ProgramBinaries* binaries) : name_(source.name)
{
    if (binaries == nullptr || !load(source, *binaries)) {
        build(source);
        if (binaries != nullptr)
            store(source, *binaries);
    }
    glObjectLabel(GL_PROGRAM, id_, -1, name_.c_str());
    glGetProgramiv(id_, GL_COMPUTE_WORK_GROUP_SIZE, work_group_size_);
    reflect_uniforms();
    reflect_blocks();
}

/// False: there is no entry, or the driver does not take it.
bool Program::load(const ShaderSource& source, const ProgramBinaries& binaries)
{
    const std::optional<ProgramBinary> binary = binaries.load(source);
    if (!binary)
        return false;
    id_ = glCreateProgram();
    glProgramBinary(
        id_, binary->format, binary->bytes.data(), static_cast<GLsizei>(binary->bytes.size()));
    while (glGetError() != GL_NO_ERROR) { }  // a format it does not know
    if (linked(id_))
        return true;
    glDeleteProgram(id_);
    return false;
}

void Program::build(const ShaderSource& source)
{
    const GLuint shader = compiled(source);
    id_ = glCreateProgram();
    glProgramParameteri(id_, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    glAttachShader(id_, shader);
    glLinkProgram(id_);
    glDeleteShader(shader);
    if (linked(id_))
        return;
    const std::string log = info_log(id_, glGetProgramiv, glGetProgramInfoLog);
    glDeleteProgram(id_);
    throw ShaderError("cannot link " + explain_log(source, log));
}

void Program::store(const ShaderSource& source, const ProgramBinaries& binaries) const
{
    GLint length = 0;
    glGetProgramiv(id_, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length <= 0)
        return;  // a driver without binaries
    ProgramBinary binary;
    binary.bytes.resize(static_cast<std::size_t>(length));
    GLenum format = 0;
    glGetProgramBinary(id_, length, &length, &format, binary.bytes.data());
    binary.format = format;
    binary.bytes.resize(static_cast<std::size_t>(length));
    if (glGetError() == GL_NO_ERROR && length > 0)
        binaries.store(source, binary);
}

Program::~Program()
{
    glDeleteProgram(id_);
}

void Program::reflect_uniforms()
{
    GLint count = 0;
    glGetProgramInterfaceiv(id_, GL_UNIFORM, GL_ACTIVE_RESOURCES, &count);
    GLint next_texture_unit = 0;
    GLint next_image_unit = 0;
    for (GLint i = 0; i < count; ++i) {
        const GLenum wanted[] = {GL_TYPE, GL_LOCATION, GL_BLOCK_INDEX};
        GLint found[3];
        glGetProgramResourceiv(
            id_, GL_UNIFORM, static_cast<GLuint>(i), 3, wanted, 3, nullptr, found);
        if (found[2] != -1)
            continue;  // a member of a uniform block
        UniformVariable variable{static_cast<GLenum>(found[0]), found[1], -1};
        if (kind_of(variable.type) == VariableKind::kSampler)
            variable.unit = next_texture_unit++;
        if (kind_of(variable.type) == VariableKind::kImage)
            variable.unit = next_image_unit++;
        if (variable.unit >= 0)
            glProgramUniform1i(id_, variable.location, variable.unit);
        uniforms_[resource_name(id_, GL_UNIFORM, static_cast<GLuint>(i))] = variable;
    }
}

void Program::reflect_blocks()
{
    GLint count = 0;
    glGetProgramInterfaceiv(id_, GL_UNIFORM_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        glUniformBlockBinding(id_, i, i);
        uniform_blocks_[resource_name(id_, GL_UNIFORM_BLOCK, i)] = i;
    }
    glGetProgramInterfaceiv(id_, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
        glShaderStorageBlockBinding(id_, i, i);
        storage_blocks_[resource_name(id_, GL_SHADER_STORAGE_BLOCK, i)] = i;
    }
}

}  // namespace farlight
