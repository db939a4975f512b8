// farlight record: plays a camera path in lockstep and writes numbered frames.
#include "client/camera_path.h"
#include "client/cli/command.h"
#include "client/cli/target.h"
#include "client/picture_file.h"
#include "client/session.h"

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

namespace farlight::client {
namespace {

struct Options {
    TargetOptions target;
    std::string path;
    double orbit = 0;
    int frames = 0;  ///< 0: as long as the path.
    std::string out;
    std::string format = "png";
    bool json = false;
};

/// The camera's way: a pose for each frame, and how many frames there are.
struct Track {
    std::function<Pose(int)> pose;
    int frames;
};

Track orbit_of(const Options& options, const protocol::Welcome& welcome)
{
    const int frames = options.frames > 0 ? options.frames : 1;
    return {[welcome, degrees = options.orbit, frames](int frame) {
                return orbit(
                    welcome.camera, middle_of(welcome.scene), orbit_angle(degrees, frame, frames));
            },
        frames};
}

Track path_of(const Options& options, const protocol::Welcome& welcome)
{
    const auto named = welcome.camera_paths.find(options.path);
    const auto keyframes = named != welcome.camera_paths.end() && !named->second.empty()
        ? named->second
        : read_keyframes(JsonInput::read(options.path));
    const int whole = 1 + static_cast<int>(std::floor(keyframes.back().frame));
    return {[keyframes](int frame) { return pose_at(keyframes, frame); },
        options.frames > 0 ? options.frames : whole};
}

protocol::Format wire_format(const std::string& format)
{
    if (format == "png")
        return protocol::Format::kPng;
    return format == "jpg" ? protocol::Format::kJpeg444 : protocol::Format::kRaw;
}

/// PNG and JPEG are kept as the server encoded them.
void write_frame(const std::filesystem::path& file, const Frame& frame)
{
    if (frame.header.format == protocol::Format::kRaw)
        write_picture(file, decode_picture(frame.header, frame.payload));
    else
        write_bytes(file, frame.payload);
}

nlohmann::json report(int number, const std::string& file, const Frame& frame)
{
    const auto& header = frame.header;
    nlohmann::json passes = nlohmann::json::array();
    for (const auto& pass : header.passes)
        passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
    return {{"frame", number}, {"file", file}, {"trace_ms", header.trace_us / 1000.0},
        {"denoise_ms", header.denoise_us / 1000.0}, {"encode_ms", header.encode_us / 1000.0},
        {"samples", header.accumulated_samples}, {"nonfinite", header.nonfinite_count},
        {"negative", header.negative_count}, {"clamped", header.clamped_count},
        {"bytes", frame.payload.size()}, {"passes", passes}};
}

void print_line(const nlohmann::json& frame)
{
    std::printf("%s  trace %.1f ms  denoise %.1f ms  encode %.1f ms  %u samples  %u non-finite\n",
        frame["file"].get<std::string>().c_str(), frame["trace_ms"].get<double>(),
        frame["denoise_ms"].get<double>(), frame["encode_ms"].get<double>(),
        frame["samples"].get<unsigned>(), frame["nonfinite"].get<unsigned>());
}

/// What the loader left out or repaired.
void tell_notes(const protocol::Welcome& welcome)
{
    for (const std::string& note : welcome.scene.notes)
        say("scene: " + note);
}

int run(const Options& options)
{
    std::error_code problem;
    std::filesystem::create_directories(options.out, problem);
    if (problem)
        throw InputError("--out " + options.out + ": " + problem.message());
    const Target target(options.target);
    Session session(
        target.url(), target.hello(protocol::Mode::kLockstep, wire_format(options.format)));
    tell_notes(session.welcome());
    const Track track = options.path.empty() ? orbit_of(options, session.welcome())
                                             : path_of(options, session.welcome());

    nlohmann::json reports = nlohmann::json::array();
    for (int i = 0; i < track.frames; ++i) {
        const Frame frame = session.draw(track.pose(i));
        char name[32];
        std::snprintf(name, sizeof name, "frame_%05d.%s", i, options.format.c_str());
        write_frame(std::filesystem::path(options.out) / name, frame);
        const nlohmann::json line = report(i, name, frame);
        if (!options.json)
            print_line(line);
        reports.push_back(line);
    }
    if (options.json)
        print_json({{"out", options.out}, {"frames", reports}});
    session.close();
    return kDone;
}

}  // namespace

Command add_record(CLI::App& farlight)
{
    auto* app =
        farlight.add_subcommand("record", "play a camera path in lockstep and write its frames");
    auto options = std::make_shared<Options>();
    options->target.add_to(*app);
    auto* path = app->add_option(
        "--path", options->path, "name of a camera path of the scene, or a JSON file of keyframes");
    auto* turn = app->add_option("--orbit", options->orbit,
        "turn the camera by this many degrees in all about the scene's middle");
    path->excludes(turn);
    app->add_option("--frames", options->frames, "number of frames; a path's own length if absent")
        ->check(CLI::Range(1, 1'000'000));
    app->add_option("--out", options->out, "folder for the frames")->required();
    app->add_option("--format", options->format, "png, jpg, or linear radiance as pfm or exr")
        ->check(CLI::IsMember({"png", "jpg", "pfm", "exr"}))
        ->capture_default_str();
    app->add_flag("--json", options->json, "print per-frame times as JSON");
    return {app, [options] { return run(*options); }};
}

}  // namespace farlight::client
