// The command line of farlight-server.
#include "server/flags.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdlib>
#include <iostream>

namespace farlight {
namespace {

/// $XDG_CACHE_HOME/farlight/programs, else ~/.cache/farlight/programs; nothing where neither is
/// known.
std::optional<std::filesystem::path> default_program_folder()
{
    const auto variable = [](const char* name) -> std::optional<std::filesystem::path> {
        const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets any
        return value == nullptr || *value != '/' ? std::nullopt
                                                 : std::optional<std::filesystem::path>(value);
    };
    if (const auto cache = variable("XDG_CACHE_HOME"))
        return *cache / "farlight" / "programs";
    if (const auto home = variable("HOME"))
        return *home / ".cache" / "farlight" / "programs";
    return std::nullopt;
}

/// What CLI11 leaves as text.
struct Texts {
    std::vector<std::string> settings;
    std::string size;
    std::string log_level = "info";
    std::string program_cache;
};

/// Everything but the scene and the one-shot questions: the words of the command line.
void add_options(CLI::App& app, Flags& flags, Texts& texts)
{
    auto& [settings, size, log_level, program_cache] = texts;
    app.add_option("--scene", flags.scene, "Farlight scene (.json) or glTF 2.0 (.gltf, .glb)");
    app.add_option("--device", flags.renderer.device,
           "auto (first hardware device, else software), software, gpu or gpu:N")
        ->capture_default_str();
    app.add_option("--bind", flags.stream.bind, "address to listen on")->capture_default_str();
    app.add_option("--port", flags.stream.port, "port to listen on; 0 picks a free one")
        ->capture_default_str();
    app.add_option("--size", size, "WxH pixels; absent: what moves at 10 frames a second here");
    app.add_option("--set", settings,
           "key=value, a setting new clients start with, whatever the scene says; repeatable")
        ->allow_extra_args(false);
    app.add_option("--frontier", flags.frontier,
        "report of farlight accuracy (JSON): what clients' budgets choose among; absent: learnt");
    app.add_option("--allow-origin", flags.stream.allowed_origins,
           "also let pages of this origin connect, as https://example.org; repeatable, * for all")
        ->allow_extra_args(false);
    app.add_option("--program-cache", program_cache,
           "folder that keeps compiled programs from one run to the next; off: none")
        ->default_str("$XDG_CACHE_HOME/farlight/programs");
    app.add_flag("!--no-edits", flags.stream.edits, "let no client change the scene");
    app.add_option("--max-clients", flags.stream.max_clients, "connections served at once")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app.add_option("--log-level", log_level, "trace, debug, info, warning, error or off")
        ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}))
        ->capture_default_str();
    app.add_flag("--list-devices", flags.list_devices, "list what --device can name, and stop");
}

/// Turns the texts that CLI11 knows nothing about into values. Throws CLI::ValidationError.
void apply(Flags& flags, const Texts& texts)
{
    const auto& [settings, size, log_level, program_cache] = texts;
    if (program_cache.empty())
        flags.renderer.program_folder = default_program_folder();
    else if (program_cache != "off")
        flags.renderer.program_folder = program_cache;
    flags.log_level = spdlog::level::from_str(log_level);
    if (!size.empty()) {
        flags.renderer.extent = parse_extent(size);
        if (!flags.renderer.extent)
            throw CLI::ValidationError(
                "--size", "found '" + size + "', expected WIDTHxHEIGHT, as 640x360");
    }
    for (const std::string& setting : settings) {
        try {
            set_setting(flags.renderer.settings, setting);
        } catch (const SettingError& problem) {
            throw CLI::ValidationError("--set", problem.what());
        }
    }
    flags.renderer.set = settings;
    if (flags.scene.empty() && !flags.list_devices)
        throw CLI::RequiredError("--scene");
}

}  // namespace

std::optional<Extent> parse_extent(std::string_view text)
{
    Extent extent;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, extent.width);
    if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x')
        return std::nullopt;
    const auto height = std::from_chars(width.ptr + 1, end, extent.height);
    if (height.ec != std::errc{} || height.ptr != end || extent.width < 1 || extent.height < 1)
        return std::nullopt;
    return extent;
}

std::variant<Flags, int> parse_flags(int argc, const char* const* argv)
{
    Flags flags;
    Texts texts;
    CLI::App app(
        "Path-traces a scene and streams it to browsers and command lines.", "farlight-server");
    app.set_version_flag("--version", "farlight-server " FARLIGHT_VERSION);
    add_options(app, flags, texts);
    try {
        app.parse(argc, argv);
        apply(flags, texts);
    } catch (const CLI::ParseError& problem) {
        return app.exit(problem, std::cout, std::cerr) == 0 ? 0 : kWrongUsage;
    }
    return flags;
}

}  // namespace farlight
