// Program: one linked compute shader and what it asks for, by the shader's own names.
#pragma once

#include "server/gl/shader_source.h"

#include <epoxy/gl.h>
#include <map>
#include <string>

namespace farlight {

/// A plain uniform, a sampler or an image of the default block.
struct UniformVariable {
    GLenum type = 0;
    GLint location = -1;
    GLint unit = -1;  ///< Texture or image unit, assigned once at link time; -1 for plain uniforms.
};

enum class VariableKind { kConstant, kSampler, kImage };
VariableKind kind_of(GLenum uniform_type);

class ProgramBinaries;

class Program {
public:
    /// Takes the program from `binaries` if it is there, else compiles, links and leaves it there.
    /// Throws ShaderError with the driver's log and the table of files.
    explicit Program(const ShaderSource& source, const ProgramBinaries* binaries = nullptr);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    GLuint id() const { return id_; }
    const std::string& name() const { return name_; }
    /// Invocations in a work group along x, y, z: said once, in the shader.
    const GLint* work_group_size() const { return work_group_size_; }
    /// Active uniforms outside blocks, by name.
    const std::map<std::string, UniformVariable, std::less<>>& uniforms() const
    {
        return uniforms_;
    }
    /// Binding points of uniform and storage blocks, by block name, assigned at link time.
    const std::map<std::string, GLuint, std::less<>>& uniform_blocks() const
    {
        return uniform_blocks_;
    }
    const std::map<std::string, GLuint, std::less<>>& storage_blocks() const
    {
        return storage_blocks_;
    }

private:
    bool load(const ShaderSource& source, const ProgramBinaries& binaries);
    void build(const ShaderSource& source);
    void store(const ShaderSource& source, const ProgramBinaries& binaries) const;
    void reflect_uniforms();
    void reflect_blocks();

    GLuint id_ = 0;
    std::string name_;
    GLint work_group_size_[3]{};
    std::map<std::string, UniformVariable, std::less<>> uniforms_;
    std::map<std::string, GLuint, std::less<>> uniform_blocks_;
    std::map<std::string, GLuint, std::less<>> storage_blocks_;
};

}  // namespace farlight
