// farlight info: what a server is.
#include "client/cli/command.h"
#include "client/cli/target.h"
#include "client/session.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

namespace farlight::client {
namespace {

struct Options {
    TargetOptions target;
    bool json = false;
    double wait = 60;  ///< For the scene's own programs [s].
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
    if (setting.value("type", "") == "text")
        return "text";
    return setting.value("lower", nlohmann::json()).dump() + " to "
        + setting.value("upper", nlohmann::json()).dump();
}

std::string join(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

void print_memory(const char* of, const std::vector<protocol::MemoryUse>& uses)
{
    std::uint64_t sum = 0;
    for (const auto& use : uses)
        sum += use.bytes;
    std::printf("memory    %s, %llu bytes\n", of, static_cast<unsigned long long>(sum));
    for (const auto& use : uses)
        std::printf(
            "  %-24s %12llu\n", use.name.c_str(), static_cast<unsigned long long>(use.bytes));
}

void print_texture_memory(const std::vector<protocol::MemoryUse>& uses)
{
    std::uint64_t sum = 0;
    int arrays = 0;
    for (const auto& use : uses)
        if (use.name.starts_with("texture_array_"))
            sum += use.bytes, ++arrays;
    if (arrays > 0)
        std::printf("textures  %d arrays with their mip levels, %llu of these bytes\n", arrays,
            static_cast<unsigned long long>(sum));
}

/// Whether the programs become the scene's own by themselves, or stay what somebody asked for.
bool chooses_by_itself(const protocol::Welcome& welcome)
{
    return std::any_of(
        welcome.settings.begin(), welcome.settings.end(), [](const nlohmann::json& setting) {
            return setting.value("key", "") == "effects"
                && setting.value("value", nlohmann::json()) == "auto";
        });
}

/// What one frame with default settings was drawn with.
void print_inspection(const protocol::Inspection& inspection)
{
    for (const auto& effect : inspection.effects)
        std::cout << "effect    " << effect.name << ": " << effect.reason << "\n";
    std::vector<std::string> constants;
    for (const auto& constant : inspection.constants)
        constants.push_back(constant.name + " " + std::to_string(constant.value));
    std::cout << "program   " << join(inspection.program) << "\n"
              << "constants " << join(constants) << "\n"
              << "passes    " << join(inspection.passes) << "\n"
              << std::flush;
    print_memory("of the scene", inspection.scene_memory);
    print_texture_memory(inspection.scene_memory);
    print_memory("of a picture", inspection.view_memory);
    std::fflush(stdout);
}

void print_text(const protocol::Welcome& welcome, const protocol::Inspection& inspection)
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
    for (const auto& [name, path] : welcome.camera_paths)
        std::cout << "path      " << name << ", frames 0 to " << path.back().frame << "\n";
    if (chooses_by_itself(welcome) && !drawn_with_own_programs(inspection))
        std::cout << "note      general programs; its own are not compiled yet\n";
    print_inspection(inspection);
    std::cout << "settings (value, what else it may be)\n" << std::flush;
    for (const auto& setting : welcome.settings)
        std::printf("  %-24s %-10s %s\n    %s\n", setting.value("key", "").c_str(),
            setting.value("value", nlohmann::json()).dump().c_str(),
            allowed_values(setting).c_str(), setting.value("help", "").c_str());
}

int run(const Options& options)
{
    const Target target(options.target);
    Session session(target.url(), target.hello(protocol::Mode::kLockstep, protocol::Format::kPng));
    const double wait = chooses_by_itself(session.welcome()) ? options.wait : 0;
    const protocol::Inspection inspection = session.await_own_programs(
        session.welcome().camera, std::chrono::milliseconds(std::lround(1000 * wait)));
    if (options.json) {
        const auto parsed = [](const protocol::ServerMessage& message) {
            return nlohmann::json::parse(protocol::encode(message));
        };
        nlohmann::json json = parsed(session.welcome());
        json["inspection"] = parsed(inspection);
        json["inspection"].erase("type");
        print_json(json);
    } else {
        print_text(session.welcome(), inspection);
    }
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
    app->add_flag(
        "--json", options->json, "print the server's welcome message and inspection as JSON");
    app->add_option("--wait", options->wait, "how long to wait for the scene's own programs [s]")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    return {app, [options] { return run(*options); }};
}

}  // namespace farlight::client
