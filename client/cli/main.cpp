// farlight: the native client. One file a command; this one reads the command line and turns errors
// into exit statuses.
#include "client/cli/command.h"
#include "client/json_input.h"
#include "client/server_process.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace farlight::client {

void say(const std::string& line)
{
    std::cerr << line << "\n";
}

void print_json(const nlohmann::json& json)
{
    std::cout << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return 0;
    const auto at =
        static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(
        values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

namespace {

int run(int argc, char** argv)
{
    CLI::App app("farlight: asks, records, tests and measures a Farlight render server");
    app.set_version_flag("--version", "farlight " FARLIGHT_VERSION);
    app.require_subcommand(1);
    const std::vector<Command> commands{add_info(app), add_record(app), add_script(app),
        add_bench(app), add_compare(app), add_accuracy(app), add_hard_cases(app)};
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& problem) {
        return app.exit(problem) == 0 ? kDone : kWrongUse;
    }
    for (const Command& command : commands)
        if (command.app->parsed())
            return command.run();
    return kWrongUse;
}

int complain(const std::exception& problem, int status)
{
    say(std::string("farlight: ") + problem.what());
    return status;
}

}  // namespace
}  // namespace farlight::client

int main(int argc, char** argv)
{
    using namespace farlight::client;
    try {
        return run(argc, argv);
    } catch (const InputError& problem) {
        return complain(problem, kWrongUse);
    } catch (const std::invalid_argument& problem) {
        return complain(problem, kWrongUse);
    } catch (const ServerProcessError& problem) {
        return complain(problem, problem.exit_status == kWrongUse ? kWrongUse : kFailed);
    } catch (const std::exception& problem) {
        return complain(problem, kFailed);
    }
}
