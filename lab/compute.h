// Runs one compute shader over arrays: the bench under every GLSL test.
#pragma once

#include "server/gl/program.h"

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace farlight {

/// A file of tests/shaders (or any text) as a shader file `name`, so that it can include the real
/// ones.
void add_shader_file(const std::string& name, const std::string& text);
std::string read_text(const std::string& path);

/// Buffer textures by name, as a scene offers them.
using Inputs = std::map<std::string, GLuint, std::less<>>;

/// Dispatches `invocations` along x with `inputs` bound by name and `output` (rgba32f texels) as
/// block `output_block`; returns its content.
std::vector<glm::vec4> run_compute(
    const Program& program, const Inputs& inputs, std::size_t output_size, std::size_t invocations);

}  // namespace farlight
