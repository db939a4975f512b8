// farlight-server: a scene file in, pictures out over WebSocket, until a signal.
#include "server/flags.h"
#include "server/gl/context.h"
#include "server/gl/gl_error.h"
#include "server/renderer_service.h"
#include "server/stream/listener.h"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/signal_set.hpp>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace farlight {
namespace {

constexpr int kFailed = 1;

int print_devices()
{
    bool any_usable = false;
    for (const DeviceDescription& device : list_devices()) {
        std::cout << device.selector << "  " << device.name;
        if (!device.version.empty())
            std::cout << "  OpenGL " << device.version;
        if (!device.problem.empty())
            std::cout << "  unusable: " << device.problem;
        std::cout << "\n";
        any_usable = any_usable || device.problem.empty();
    }
    return any_usable ? 0 : kWrongUsage;
}

void tell(const RendererDescription& description, const Flags& flags)
{
    spdlog::info("device: {} ({}, OpenGL {})", description.device, description.gl_renderer,
        description.gl_version);
    spdlog::info("scene: {}: {} triangles, {} lights", description.scene_name,
        description.triangles, description.lights);
    for (const std::string& note : description.scene_notes)
        spdlog::warn("scene: {}", note);
    for (const ActiveEffect& effect : description.effects)
        spdlog::info("calls for {}: {}", effect.name, effect.reason);
    spdlog::info("size: {}x{}, {}", description.default_extent.width,
        description.default_extent.height,
        flags.renderer.extent ? "from --size" : "measured to move at 10 frames a second here");
    if (!boost::asio::ip::make_address(flags.stream.bind).is_loopback())
        spdlog::warn("anyone who can reach {} can look at and steer this server: there is no "
                     "password and no encryption",
            flags.stream.bind);
}

/// The first signal drains, the second ends at once.
void stop_on_signals(boost::asio::signal_set& signals, Listener& listener)
{
    signals.async_wait([&](const boost::system::error_code& error, int /*signal*/) {
        if (error)
            return;
        listener.shut_down();
        signals.async_wait([](const boost::system::error_code& again, int signal) {
            if (!again)
                std::_Exit(128 + signal);
        });
    });
}

/// A command line that could only be found wrong once device and scene were known.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

FrontierReport for_this(const FrontierReport& read, const RendererDescription& description)
{
    FrontierReport report =
        report_for(read, {description.scene_name, description.triangles, description.lights},
            description.gl_renderer);
    const auto otherwise = otherwise_measured(report, description.default_extent);
    spdlog::info("frontier: {} points of {}{}", report.points.size(), report.file,
        otherwise ? ", " + *otherwise : "");
    return report;
}

int serve(const Flags& flags)
{
    StreamOptions stream = flags.stream;
    std::optional<FrontierReport> frontier;
    if (!flags.frontier.empty())
        frontier = read_frontier_report(flags.frontier);  // first: scenes take long to load
    SceneDocument document = SceneDocument::load(flags.scene);
    Renderer renderer(document.scene(), flags.renderer);
    const auto [width, height] = renderer.description()->default_extent;
    if (const auto problem = refuse_extent(static_cast<std::uint64_t>(width),
            static_cast<std::uint64_t>(height), renderer.description()->max_dimension))
        throw UsageError(*problem);
    if (const auto missing =
            what_is_missing(flags.renderer.settings.effects, renderer.description()->effects))
        throw UsageError(
            "--set effects=" + to_text(flags.renderer.settings.effects) + ": " + *missing);
    if (frontier)
        stream.frontier =
            std::make_shared<const FrontierReport>(for_this(*frontier, *renderer.description()));
    RendererService service(renderer, std::move(document));
    Listener listener(service, stream);
    tell(*renderer.description(), flags);
    boost::asio::signal_set signals(listener.context(), SIGINT, SIGTERM);
    stop_on_signals(signals, listener);
    std::cout << "farlight-server: listening on " << listener.url() << std::endl;
    listener.run();
    return renderer.failure().empty() ? 0 : kFailed;
}

int run(int argc, const char* const* argv)
{
    const auto parsed = parse_flags(argc, argv);
    if (const int* status = std::get_if<int>(&parsed))
        return *status;
    const Flags& flags = std::get<Flags>(parsed);
    spdlog::set_default_logger(spdlog::stderr_color_mt("farlight-server"));
    spdlog::set_level(flags.log_level);
    return flags.list_devices ? print_devices() : serve(flags);
}

/// Says why it ends. What the user can mend is wrong usage; the rest is a failure.
int explain(int status, const std::exception& problem)
{
    std::cerr << "farlight-server: " << problem.what() << "\n";
    return status;
}

}  // namespace
}  // namespace farlight

int main(int argc, char** argv)
{
    using namespace farlight;
    try {
        return run(argc, argv);
    } catch (const UsageError& problem) {
        return explain(kWrongUsage, problem);
    } catch (const SceneError& problem) {
        return explain(kWrongUsage, problem);
    } catch (const DeviceError& problem) {
        return explain(kWrongUsage, problem);
    } catch (const ListenError& problem) {
        return explain(kWrongUsage, problem);
    } catch (const std::exception& problem) {
        return explain(kFailed, problem);
    }
}
