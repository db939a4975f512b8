// Runs and references, one session each.
#include "client/script/play.h"

#include "client/metrics/metrics.h"

#include <algorithm>

namespace farlight::client {
namespace {

/// Keeps a frame of a reference short enough for any server's watchdog.
constexpr double kSamplesPerReferenceFrame = 4e6;
constexpr int kMaxSamplesPerPixel = 256;
constexpr std::uint32_t kReferenceSeed = 0x5EED;  // unlike any seed a run has unless it asks for it

Settings merged(Settings base, const Settings& over)
{
    for (const auto& [key, value] : over)
        base[key] = value;
    return base;
}

protocol::Hello hello_for(const Script& script, const Settings& settings)
{
    return {.client = "farlight script " FARLIGHT_VERSION,
        .mode = protocol::Mode::kLockstep,
        .format = protocol::Format::kRaw,
        .size = script.size,
        .max_in_flight = 1,
        .settings = settings};
}

FrameFacts facts_of(const Frame& frame, const Picture& picture)
{
    return {.nonfinite = frame.header.nonfinite_count + count_nonfinite(picture.linear),
        .hash = hash_bytes(frame.payload),
        .samples = frame.header.accumulated_samples,
        .history_reset = frame.header.has(protocol::frame_flags::kHistoryReset)};
}

/// `keep(frame)` decides whose pixels are kept.
std::pair<std::vector<FrameFacts>, std::map<int, Picture>> play_once(const Script& script,
    const Url& url, const Settings& settings, const std::function<bool(int)>& keep)
{
    Session session(url, hello_for(script, settings));
    if (script.edits())
        session.edit(nlohmann::json::object(), /*reset=*/true);  // what the run before has left
    std::vector<FrameFacts> facts;
    std::map<int, Picture> pictures;
    auto event = script.events.begin();
    for (int i = 0; i < script.frames; ++i) {
        bool cut = false;
        for (; event != script.events.end() && event->frame == i; ++event) {
            for (const auto& [key, value] : event->set)
                session.set(key, value);
            if (!event->edit.is_null())
                session.edit(event->edit);
            cut = cut || event->cut;
        }
        const Frame frame = session.draw(pose_of(script, session.welcome(), i), cut);
        Picture picture = decode_picture(frame.header, frame.payload);
        facts.push_back(facts_of(frame, picture));
        if (keep(i))
            pictures[i] = std::move(picture);
    }
    session.close();
    return {std::move(facts), std::move(pictures)};
}

/// Many samples at the last frame's view, with the settings that hold there.
Picture play_reference(const Script& script, const Url& url, const Progress& progress)
{
    Settings settings = script.settings;
    for (const ScriptEvent& event : script.events)
        settings = merged(settings, event.set);
    settings["seed"] = kReferenceSeed;
    settings = merged(settings, script.reference->settings);
    settings["denoiser"] = "accumulate";

    Session session(url, hello_for(script, settings));
    const auto [width, height] = session.welcome().size;
    const int per_frame = std::clamp(static_cast<int>(kSamplesPerReferenceFrame / width / height),
        1, std::min(kMaxSamplesPerPixel, script.reference->samples));
    const int frames = (script.reference->samples + per_frame - 1) / per_frame;
    progress("reference: " + std::to_string(frames) + " frames of " + std::to_string(per_frame)
        + " samples");
    session.set("samples_per_pixel", per_frame);

    const Pose pose = pose_of(script, session.welcome(), script.frames - 1);
    std::optional<Frame> last;
    for (int i = 0; i < frames; ++i)
        last = session.draw(pose);
    session.close();
    const auto wanted = static_cast<std::uint32_t>(script.reference->samples);
    if (last->header.accumulated_samples < wanted)
        throw SessionError("the reference has " + std::to_string(last->header.accumulated_samples)
            + " samples a pixel, expected " + std::to_string(wanted));
    return decode_picture(last->header, last->payload);
}

[[noreturn]] void blame_script(
    const Script& script, const std::string& where, const RefusedError& refused)
{
    throw InputError(script.file.string() + ": " + where + ": " + refused.what());
}

}  // namespace

Played play(const Script& script, const Url& url, const Progress& progress)
{
    std::vector<Call> calls;
    for (const Expectation& expectation : script.expectations)
        for (const Call& call : calls_in(expectation))
            calls.push_back(call);
    const auto keep = [&](int frame) {
        return frame == script.frames - 1
            || std::any_of(
                calls.begin(), calls.end(), [&](const Call& call) { return call.frame == frame; });
    };

    Played played;
    for (const auto& [name, settings] : script.runs) {
        const bool twice =
            std::any_of(calls.begin(), calls.end(), [&, &run = name](const Call& call) {
                return call.function->name == "same_bytes_twice"
                    && (call.run.empty() || call.run == run);
            });
        progress(
            name + ": " + std::to_string(script.frames) + " frames" + (twice ? ", twice" : ""));
        const Settings all = merged(script.settings, settings);
        try {
            auto [frames, pictures] = play_once(script, url, all, keep);
            PlayedRun run{
                .frames = std::move(frames), .again = {}, .pictures = std::move(pictures)};
            if (twice)
                run.again = play_once(script, url, all, [](int) { return false; }).first;
            played.runs[name] = std::move(run);
        } catch (const RefusedError& refused) {
            blame_script(script, "/runs/" + name, refused);
        }
    }
    if (script.reference) {
        try {
            played.reference = play_reference(script, url, progress);
        } catch (const RefusedError& refused) {
            blame_script(script, "/reference", refused);
        }
    }
    return played;
}

}  // namespace farlight::client
