// farlight info: what a server is.
#include "client/cli/command.h"
#include "client/cli/target.h"
#include "client/session.h"

#include <cstdio>
#include <iostream>
#include <memory>

namespace farlight::client {
namespace {

struct Options {
    TargetOptions target;
    bool json = false;
};

/// "0 to 10", "none, svgf" or "true, false".
std::string allowed_values(const nlohmann::json& setting)
{
    if (setting.contains("choices")) {
        std::string text;
        for (const auto& choice : setting["choices"])
            text += (text.empty() ? "" : ", ") + choice.get<std::string>();
        return text;
    }
    if (setting.value("type", "") == "boolean")
        return "true, false";
    return setting.value("lower", nlohmann::json()).dump() + " to "
        + setting.value("upper", nlohmann::json()).dump();
}

void print_text(const protocol::Welcome& welcome)
{
    const auto& scene = welcome.scene;
    std::cout << "server    " << welcome.server << ", protocol " << welcome.protocol << "\n"
              << "device    " << welcome.device << "\n"
              << "renderer  " << welcome.gl_renderer << "\n"
              << "scene     " << scene.name << " (" << scene.file << "), " << scene.triangles
              << " triangles, " << scene.lights << " lights\n"
              << "size      " << welcome.size[0] << "x" << welcome.size[1] << ", at most "
              << welcome.limits.max_dimension << " either way\n";
    for (const std::string& note : scene.notes)
        std::cout << "note      " << note << "\n";
    for (const std::string& effect : welcome.effects)
        std::cout << "effect    " << effect << "\n";
    for (const auto& [name, path] : welcome.camera_paths)
        std::cout << "path      " << name << ", frames 0 to " << path.back().frame << "\n";
    std::cout << "settings (value, what else it may be)\n";
    for (const auto& setting : welcome.settings)
        std::printf("  %-24s %-10s %s\n    %s\n", setting.value("key", "").c_str(),
            setting.value("value", nlohmann::json()).dump().c_str(),
            allowed_values(setting).c_str(), setting.value("help", "").c_str());
}

int run(const Options& options)
{
    const Target target(options.target);
    Session session(target.url(), target.hello(protocol::Mode::kLockstep, protocol::Format::kPng));
    if (options.json)
        print_json(
            nlohmann::json::parse(protocol::encode(protocol::ServerMessage(session.welcome()))));
    else
        print_text(session.welcome());
    session.close();
    return kDone;
}

}  // namespace

Command add_info(CLI::App& farlight)
{
    auto* app =
        farlight.add_subcommand("info", "what a server is: device, scene, effects, settings");
    auto options = std::make_shared<Options>();
    options->target.add_to(*app);
    app->add_flag("--json", options->json, "print the server's welcome message as JSON");
    return {app, [options] { return run(*options); }};
}

}  // namespace farlight::client
