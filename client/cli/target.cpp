// --url and --scene.
#include "client/cli/target.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <charconv>

namespace farlight::client {
namespace {

/// `key=value` with the value as text: the server reads numbers out of it.
std::map<std::string, nlohmann::json> settings_of(const std::vector<std::string>& set)
{
    std::map<std::string, nlohmann::json> settings;
    for (const std::string& text : set) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::invalid_argument("--set: found '" + text + "', expected key=value");
        settings[text.substr(0, equals)] = text.substr(equals + 1);
    }
    return settings;
}

std::vector<std::string> server_arguments(const TargetOptions& options, const std::string& scene)
{
    std::vector<std::string> arguments{"--scene", scene, "--port", std::to_string(options.port)};
    const auto add = [&](const char* name, const std::string& value) {
        arguments.emplace_back(name);
        arguments.push_back(value);
    };
    if (!options.device.empty())
        add("--device", options.device);
    if (!options.size.empty())
        add("--size", options.size);
    for (const std::string& setting : options.set)
        add("--set", setting);
    return arguments;
}

}  // namespace

protocol::Size parse_size(const std::string& text)
{
    const auto cross = text.find('x');
    protocol::Size size{};
    const auto side = [&](std::string_view digits, std::uint32_t& out) {
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), out);
        return error == std::errc() && end == digits.data() + digits.size() && out >= 1
            && out <= 65535;
    };
    const std::string_view view(text);
    if (cross == std::string::npos || !side(view.substr(0, cross), size[0])
        || !side(view.substr(cross + 1), size[1]))
        throw std::invalid_argument(
            "--size: found '" + text + "', expected WIDTHxHEIGHT in 1 to 65535");
    return size;
}

void TargetOptions::add_to(CLI::App& command, bool scene_option)
{
    command.add_option("--url", url, "a running server: ws://HOST:PORT/ws");
    if (scene_option)
        command.add_option(
            "--scene", scene, "start a private server with this scene, and stop it afterwards");
    command.add_option("--device", device, "of the private server: auto, software, gpu or gpu:N");
    command.add_option("--size", size, "WIDTHxHEIGHT of the frames");
    command.add_option("--set", set, "key=value of any setting; may be repeated")
        ->allow_extra_args(false);
    command.add_option("--port", port, "of the private server; 0 picks one")
        ->check(CLI::Range(0, 65535));
}

Target::Target(const TargetOptions& options, const std::string& scene)
{
    const std::string& wanted = scene.empty() ? options.scene : scene;
    if (!options.size.empty())
        size_ = parse_size(options.size);
    settings_ = settings_of(options.set);
    if (!options.url.empty()) {
        if (!options.scene.empty() || !options.device.empty() || options.port != 0)
            throw std::invalid_argument(
                "--url names a running server: --scene, --device and --port do not go with it");
        url_ = parse_url(options.url);
        return;
    }
    if (wanted.empty())
        throw std::invalid_argument("found neither --url nor --scene, expected one of them");
    server_ = std::make_unique<ServerProcess>(
        server_beside_this_program(), server_arguments(options, wanted));
    url_ = server_->url();
    size_.reset();
    settings_.clear();
}

protocol::Hello Target::hello(protocol::Mode mode, protocol::Format format) const
{
    return {.client = "farlight " FARLIGHT_VERSION,
        .mode = mode,
        .format = format,
        .size = size_,
        .settings = settings_};
}

}  // namespace farlight::client
