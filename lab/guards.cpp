// See the header.
#include "lab/guards.h"

#include "lab/groups.h"
#include "lab/host_guards.h"
#include "server/gl/shader_source.h"

#include <stdexcept>

namespace farlight::lab {

std::vector<Guard> all_guards()
{
    std::vector<Guard> guards;
    for (const Group& group : all_groups())
        guards.insert(guards.end(), group.guards.begin(), group.guards.end());
    if (const std::string problem = disagreement(guards, HostGuards::names()); !problem.empty())
        throw std::logic_error(problem);
    return guards;
}

void take_out(const Guard& guard)
{
    if (guard.in_host()) {
        HostGuards::take_out(guard.name);
        return;
    }
    const auto file = shader_files().find(guard.file);
    const std::size_t at =
        file == shader_files().end() ? std::string::npos : file->second.find(guard.text);
    if (at == std::string::npos || file->second.find(guard.text, at + 1) != std::string::npos)
        throw std::runtime_error("guard '" + std::string(guard.name)
            + "': its text is not in shaders/" + std::string(guard.file) + " exactly once");
    file->second.replace(at, guard.text.size(), guard.instead);
}

}  // namespace farlight::lab
