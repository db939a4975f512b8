// Uniforms by kind and type, blocks by name.
#include "server/render/declaration_check.h"

#include "server/gl/gl_error.h"

#include <spdlog/spdlog.h>

namespace farlight {
namespace {

void complain(const Pass& pass, const std::string& variable, const std::string& problem)
{
    throw ShaderError(
        "pass '" + pass.name + "': '" + variable + "' " + problem + " (" + pass.shader + ")");
}

/// Whether the pass gives `name` a value of the right kind and type.
bool declares(const Pass& pass, const std::string& name, const UniformVariable& variable)
{
    const bool is_image = kind_of(variable.type) == VariableKind::kImage;
    return std::any_of(pass.uses.begin(), pass.uses.end(), [&](const auto& use) {
        return use.name == name && (!use.write || is_image);
    }) || std::any_of(pass.constants.begin(), pass.constants.end(), [&](const auto& row) {
        return row.first == name && glsl_type(row.second) == variable.type;
    }) || (pass.scene_inputs != nullptr && pass.scene_inputs->buffers.contains(name));
}

}  // namespace

/// Used by the shader but declared by nobody.
void DeclarationCheck::operator()(
    const Pass& pass, const Program& program, const std::vector<BlockInput>& blocks)
{
    const auto is_offered = [&](const std::string& name) {
        return std::any_of(
            blocks.begin(), blocks.end(), [&](const auto& block) { return block.name == name; });
    };
    for (const auto& [name, variable] : program.uniforms())
        if (!declares(pass, name, variable))
            complain(pass, name, "is used by the shader but not declared with this kind and type");
    for (const auto* block_map : {&program.uniform_blocks(), &program.storage_blocks()})
        for (const auto& [name, binding] : *block_map)
            if (!is_offered(name))
                complain(pass, name, "is a block the shader uses but the frame does not offer");
    check_declared(pass, program);
}

/// Declared by the pass but not active in the shader: a setting that reaches nothing.
void DeclarationCheck::check_declared(const Pass& pass, const Program& program)
{
    const auto check_name = [&](const std::string& name) {
        if (program.uniforms().contains(name))
            return;
        if (strict_)
            complain(pass, name, "is declared but the shader does not use it");
        if (warned_.insert(pass.name + "/" + name).second)
            spdlog::debug(
                "pass '{}': '{}' is declared but not active in {}", pass.name, name, pass.shader);
    };
    for (const Pass::Use& use : pass.uses)
        check_name(use.name);
    for (const auto& row : pass.constants)
        check_name(row.first);
}

}  // namespace farlight
