// farlight bench: milliseconds a pass, and latency beyond what drawing and encoding take.
#include "client/camera_path.h"
#include "client/cli/bad_values.h"
#include "client/cli/bench_effects.h"
#include "client/cli/bench_setting.h"
#include "client/cli/command.h"
#include "client/cli/target.h"
#include "client/picture.h"
#include "client/session.h"

#include <cstdio>
#include <memory>

namespace farlight::client {
namespace {

constexpr int kWarmUpFrames = 4;  // shaders compile, caches fill
constexpr double kDegreesPerFrame = 1;
constexpr protocol::Size kLatencySize{320, 180};

struct Options {
    TargetOptions target;
    int frames = 24;
    int moves = 100;
    bool json = false;
    bool effects = false;
    bool leave_one_in = false;
    std::string turns;  ///< "KEY=A,B"
    std::vector<std::string> scenes;
};

struct PassTimes {
    protocol::Size size;
    std::vector<std::pair<std::string, double>>
        passes;  ///< Median milliseconds, in execution order.
    double trace = 0, denoise = 0, encode = 0;  ///< Median milliseconds.
    BadValuesMet met;  ///< In all frames, those to warm up included.
};

struct Latency {
    int moves = 0;
    double median = 0,
           p95 = 0;  ///< Camera sent to picture decoded, less wait, render and encode [ms].
    double whole_median = 0;  ///< The same less nothing [ms].
};

Pose pose_at_frame(const protocol::Welcome& welcome, int frame)
{
    return orbit(welcome.camera, middle_of(welcome.scene), kDegreesPerFrame * frame);
}

PassTimes measure_passes(const Target& target, const protocol::Size& size, int frames)
{
    auto hello = target.hello(protocol::Mode::kLockstep, protocol::Format::kJpeg420);
    hello.size = size;
    Session session(target.url(), hello);
    std::vector<std::pair<std::string, std::vector<double>>> passes;
    std::vector<double> trace, denoise, encode;
    BadValuesMet met;
    for (int i = 0; i < kWarmUpFrames + frames; ++i) {
        const auto header = session.draw(pose_at_frame(session.welcome(), i)).header;
        met.add(header);
        if (i < kWarmUpFrames)
            continue;
        trace.push_back(header.trace_us / 1000.0);
        denoise.push_back(header.denoise_us / 1000.0);
        encode.push_back(header.encode_us / 1000.0);
        for (std::size_t p = 0; p < header.passes.size(); ++p) {
            if (p == passes.size())
                passes.push_back({header.passes[p].name, {}});
            passes[p].second.push_back(header.passes[p].milliseconds);
        }
    }
    session.close();
    PassTimes times{.size = size,
        .passes = {},
        .trace = quantile(trace, 0.5),
        .denoise = quantile(denoise, 0.5),
        .encode = quantile(encode, 0.5),
        .met = std::move(met)};
    for (const auto& [name, values] : passes)
        times.passes.emplace_back(name, quantile(values, 0.5));
    return times;
}

Latency measure_latency(const Target& target, int moves)
{
    using Clock = std::chrono::steady_clock;
    auto hello = target.hello(protocol::Mode::kInteractive, protocol::Format::kJpeg420);
    hello.size = kLatencySize;
    Session session(target.url(), hello);
    std::vector<double> beyond, whole;
    for (int i = 0; i < kWarmUpFrames + moves; ++i) {
        const auto sent = Clock::now();
        const std::uint32_t sequence = session.send_camera(pose_at_frame(session.welcome(), i));
        bool seen = false;
        while (!seen) {
            const Frame frame = session.next_frame();
            const Picture picture = decode_picture(frame.header, frame.payload);
            const double ms =
                std::chrono::duration<double, std::milli>(Clock::now() - sent).count();
            session.acknowledge(frame);
            const auto& header = frame.header;
            seen = header.camera_sequence == sequence;
            if (!seen || i < kWarmUpFrames)
                continue;
            whole.push_back(ms);
            beyond.push_back(ms
                - (header.wait_us + header.trace_us + header.denoise_us + header.encode_us)
                    / 1000.0);
        }
    }
    session.close();
    return {.moves = moves,
        .median = quantile(beyond, 0.5),
        .p95 = quantile(beyond, 0.95),
        .whole_median = quantile(whole, 0.5)};
}

void print_table(const std::vector<PassTimes>& sizes, const Latency& latency)
{
    for (const PassTimes& times : sizes) {
        std::printf("%ux%u, median milliseconds\n", times.size[0], times.size[1]);
        for (const auto& [name, milliseconds] : times.passes)
            std::printf("  %-28s %8.2f\n", name.c_str(), milliseconds);
        std::printf("  %-28s %8.2f\n  %-28s %8.2f\n  %-28s %8.2f\n", "= trace", times.trace,
            "= denoise", times.denoise, "encode (jpeg420)", times.encode);
        std::printf("%s", times.met.to_text().c_str());
    }
    std::printf("latency at %ux%u, %d camera moves, sent to decoded\n", kLatencySize[0],
        kLatencySize[1], latency.moves);
    std::printf("  %-28s %8.2f median\n", "whole", latency.whole_median);
    std::printf("  %-28s %8.2f median %8.2f p95\n", "less wait, render, encode", latency.median,
        latency.p95);
}

nlohmann::json to_json(const std::vector<PassTimes>& sizes, const Latency& latency)
{
    nlohmann::json json{{"latency",
        {{"size", kLatencySize}, {"moves", latency.moves},
            {"whole_median_ms", latency.whole_median},
            {"beyond_render_and_encode_median_ms", latency.median},
            {"beyond_render_and_encode_p95_ms", latency.p95}}}};
    for (const PassTimes& times : sizes) {
        nlohmann::json passes = nlohmann::json::array();
        for (const auto& [name, milliseconds] : times.passes)
            passes.push_back({{"name", name}, {"median_ms", milliseconds}});
        json["sizes"].push_back({{"size", times.size}, {"passes", passes},
            {"trace_ms", times.trace}, {"denoise_ms", times.denoise}, {"encode_ms", times.encode},
            {"bad_values", times.met.to_json()}});
    }
    return json;
}

int run(const Options& options)
{
    if (options.effects || options.leave_one_in)
        return bench_effects(
            options.target, {options.scenes, options.frames, options.leave_one_in, options.json});
    if (!options.turns.empty())
        return bench_setting(options.target, options.turns, options.frames, options.json);
    if (!options.scenes.empty())
        throw std::invalid_argument("scenes after the options go with --effects");
    const Target target(options.target);
    std::vector<protocol::Size> sizes{{320, 180}, {640, 360}};
    if (!options.target.size.empty())
        sizes = {parse_size(options.target.size)};
    std::vector<PassTimes> times;
    for (const protocol::Size& size : sizes) {
        say("passes at " + std::to_string(size[0]) + "x" + std::to_string(size[1]));
        times.push_back(measure_passes(target, size, options.frames));
    }
    say("latency");
    const Latency latency = measure_latency(target, options.moves);
    if (options.json)
        print_json(to_json(times, latency));
    else
        print_table(times, latency);
    return kDone;
}

}  // namespace

Command add_bench(CLI::App& farlight)
{
    auto* app = farlight.add_subcommand("bench", "measure milliseconds a pass, and latency");
    auto options = std::make_shared<Options>();
    options->target.add_to(*app);
    app->add_option("--frames", options->frames, "frames a size")
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    app->add_option("--moves", options->moves, "camera moves for latency")
        ->check(CLI::Range(1, 100'000))
        ->capture_default_str();
    app->add_flag("--effects", options->effects,
        "measure instead what it saves to compile only what a scene calls for");
    app->add_flag("--leave-one-in", options->leave_one_in,
        "with --effects: of the first scene also the cost of each effect that it lacks");
    app->add_option("--turns", options->turns,
        "KEY=A,B: measure instead what a setting costs, drawing with both values in turns");
    app->add_option(
        "scenes", options->scenes, "with --effects: scene files, a private server each");
    app->add_flag("--json", options->json, "print JSON");
    return {app, [options] { return run(*options); }};
}

}  // namespace farlight::client
