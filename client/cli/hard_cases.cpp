// farlight hard-cases: starts the laboratory, which needs OpenGL; this client does not.
#include "client/cli/command.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace farlight::client {
namespace {

/// Becomes farlight-hard-cases beside this program; returns only where it cannot.
int run_laboratory(const CLI::App& command)
{
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "farlight-hard-cases";
    std::vector<std::string> arguments = command.remaining();
    arguments.insert(arguments.begin(), "farlight hard-cases");
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments)
        pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    execv(program.c_str(), pointers.data());
    say("farlight hard-cases: cannot start " + program.string() + ": " + std::strerror(errno));
    return kWrongUse;
}

}  // namespace

Command add_hard_cases(CLI::App& farlight)
{
    CLI::App* command = farlight.add_subcommand(
        "hard-cases", "run the numerical laboratory: inputs that break renderers, one line a case");
    command->set_help_flag();  // the laboratory has its own
    command->prefix_command();
    return {command, [command] { return run_laboratory(*command); }};
}

}  // namespace farlight::client
