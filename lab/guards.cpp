// See the header.
#include "lab/guards.h"

#include "server/gl/shader_source.h"

#include <stdexcept>

namespace farlight::lab {
namespace {

constexpr Guard kGuards[] = {
    {"running_mean", "49 51", "accumulate/accumulate.comp", "mean = old + (radiance - old) / count;",
        "mean = (old * (count - 1.0) + radiance) / count;"},
};

}  // namespace

std::span<const Guard> all_guards()
{
    return kGuards;
}

void take_out(const Guard& guard)
{
    const auto file = shader_files().find(guard.file);
    const std::size_t at =
        file == shader_files().end() ? std::string::npos : file->second.find(guard.text);
    if (at == std::string::npos || file->second.find(guard.text, at + 1) != std::string::npos)
        throw std::runtime_error("guard '" + std::string(guard.name) + "': its text is not in shaders/"
            + std::string(guard.file) + " exactly once");
    file->second.replace(at, guard.text.size(), guard.instead);
}

}  // namespace farlight::lab
