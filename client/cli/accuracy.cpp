// farlight accuracy: sweeps settings and writes the report of what accuracy costs in time.
#include "client/accuracy/report_files.h"
#include "client/accuracy/sweep.h"
#include "client/cli/command.h"
#include "client/cli/target.h"
#include "client/json_input.h"

#include <csignal>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <unistd.h>

namespace farlight::client {
namespace {

constexpr const char* kQuickSize = "160x90";

struct Options {
    TargetOptions target;
    std::string out;
    std::string grid = "normal";
    bool quick = false;
    bool json = false;
    SweepExtent extent;
};

/// While it lives, SIGINT and SIGTERM are wishes to stop.
class StopSignals {
public:
    StopSignals()
    {
        struct sigaction action = {};
        action.sa_handler = [](int) { Progress::wish_to_stop(); };
        sigaction(SIGINT, &action, &interrupt_);
        sigaction(SIGTERM, &action, &terminate_);
    }
    ~StopSignals()
    {
        sigaction(SIGINT, &interrupt_, nullptr);
        sigaction(SIGTERM, &terminate_, nullptr);
    }
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

private:
    struct sigaction interrupt_ = {};
    struct sigaction terminate_ = {};
};

GridSize grid_of(const Options& options)
{
    static const std::map<std::string, GridSize> grids{{"normal", GridSize::kNormal},
        {"quick", GridSize::kQuick}, {"classic", GridSize::kClassic}, {"tiny", GridSize::kTiny}};
    return grids.at(options.quick ? "quick" : options.grid);
}

/// Tells one build of the private server from the next; a server that runs already says no more
/// than its version.
std::string build_of_server(const Options& options)
{
    if (!options.target.url.empty())
        return "";
    std::ifstream stream(server_beside_this_program(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return std::to_string(hash_bytes(std::as_bytes(std::span(bytes))));
}

/// 0 when frames and their passes agree on the time.
int status_of(const nlohmann::json& report)
{
    const auto& check = report.at("timing_check");
    if (!check.at("failed").get<bool>())
        return kDone;
    say("the passes' times are " + std::to_string(100 * check.at("worst").get<double>())
        + " % off the whole frame's: do not trust the times");
    return kFailed;
}

int run(Options options)
{
    SweepOptions sweep_options{.extent = options.extent, .out = options.out};
    sweep_options.extent.grid = grid_of(options);
    if (sweep_options.extent.grid != GridSize::kNormal && options.target.size.empty())
        options.target.size = kQuickSize;
    std::error_code problem;
    std::filesystem::create_directories(options.out, problem);
    if (problem)
        throw InputError("--out " + options.out + ": " + problem.message());
    sweep_options.scene = options.target.scene;
    sweep_options.server = build_of_server(options);

    const StopSignals signals;
    const Target target(options.target);
    const auto hello = target.hello(protocol::Mode::kLockstep, protocol::Format::kRaw);
    nlohmann::json report;
    try {
        Progress progress(isatty(STDERR_FILENO) == 1);
        report = sweep(target.url(), hello, sweep_options, progress);
    } catch (const std::exception&) {
        if (!Progress::stop_wished())
            throw;
        // A private server in the same terminal ends with the same key, so any error may be this.
        say("stopped; the same command goes on from here");
        return kFailed;
    }
    write_report(options.out, report);
    if (options.json) {
        report.erase("gallery");
        print_json(report);
    } else {
        std::cout << summary_text(report);
    }
    say("report: " + (std::filesystem::path(options.out) / "accuracy.html").string());
    return status_of(report);
}

}  // namespace

Command add_accuracy(CLI::App& farlight)
{
    auto* app = farlight.add_subcommand(
        "accuracy", "measure what accuracy costs in time; a report as HTML, CSV and JSON");
    auto options = std::make_shared<Options>();
    options->target.add_to(*app);
    app->add_option("--out", options->out,
           "folder of the report; what an interrupted run measured is taken from there")
        ->required();
    auto* quick = app->add_flag("--quick", options->quick,
        "fewer points at 160x90: two minutes for a simple scene on two cores");
    app->add_option("--grid", options->grid,
           "which points: normal; quick, fewer; classic, raw samples against one filtered; tiny, "
           "for "
           "tests")
        ->check(CLI::IsMember({"normal", "quick", "classic", "tiny"}))
        ->capture_default_str()
        ->excludes(quick);
    app->add_option("--seeds", options->extent.seeds, "frames a point, each with a seed of its own")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
    app->add_option("--reference-samples", options->extent.reference_samples,
           "of the reference, a pixel; if absent 128 times the most of a measured frame, 256 in "
           "classic and normal grids")
        ->check(CLI::Range(32, 10'000'000));
    app->add_option("--orbit", options->extent.degrees_per_frame,
           "degrees that the camera turns a frame while histories fill; 0: it rests")
        ->check(CLI::Range(-90.0, 90.0))
        ->capture_default_str();
    app->add_flag("--json", options->json, "print the report as JSON");
    return {app, [options] { return run(*options); }};
}

}  // namespace farlight::client
