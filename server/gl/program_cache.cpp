// Programs by shader path and defines.
#include "server/gl/program_cache.h"

namespace farlight {

const Program& ProgramCache::get(const std::string& shader, const Defines& defines)
{
    std::string key = shader;
    for (const auto& [name, value] : defines)
        key.append("\n").append(name).append(" ").append(value);
    std::unique_ptr<Program>& program = programs_[key];
    if (program == nullptr)
        program = std::make_unique<Program>(load_shader_source(shader, defines));
    return *program;
}

}  // namespace farlight
