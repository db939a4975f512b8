// Programs by shader path and defines.
#include "server/gl/program_cache.h"

namespace farlight {

const Program& ProgramCache::get(const ProgramKey& key)
{
    std::unique_ptr<Program>& program = programs_[key];
    if (program == nullptr) {
        try {
            program =
                std::make_unique<Program>(load_shader_source(key.shader, key.defines), binaries_);
        } catch (...) {
            programs_.erase(key);
            throw;
        }
    }
    return *program;
}

void ProgramCache::adopt(const ProgramKey& key, std::unique_ptr<Program> program)
{
    std::unique_ptr<Program>& place = programs_[key];
    if (place != nullptr)
        dropped_.push_back(std::move(place));
    place = std::move(program);
}

std::unique_ptr<Program> ProgramCache::take(const ProgramKey& key)
{
    const auto found = programs_.find(key);
    if (found == programs_.end())
        return nullptr;
    std::unique_ptr<Program> program = std::move(found->second);
    programs_.erase(found);
    return program;
}

}  // namespace farlight
