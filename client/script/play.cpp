// Runs and references, one session each.
#include "client/script/play.h"

#include "client/metrics/metrics.h"

#include <algorithm>
#include <set>

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

/// What expectations want of one run besides the facts of its frames.
struct Wanted {
    std::set<int> pictures;
    std::set<int> sequences;  ///< By their first frame.
    bool twice = false;
    bool revealed = false;
};

Wanted wanted_of(const Script& script, const std::string& run)
{
    const int last = script.frames - 1;
    Wanted wanted{.pictures = {last}};
    for (const Expectation& expectation : script.expectations)
        for (const Call& call : calls_in(expectation)) {
            const Function& function = *call.function;
            if (!call.run.empty() && call.run != run)
                continue;
            wanted.twice = wanted.twice || function.name == "same_bytes_twice";
            wanted.revealed = wanted.revealed || function.name == "ghost";
            if (function.of == Of::kFrame)
                wanted.pictures.insert(call.frame.value_or(last));
            if (function.name == "lag")
                for (int i = call.frame.value_or(0); i < last; ++i)
                    wanted.pictures.insert(i);
            else if (function.of == Of::kFramesFrom)
                wanted.sequences.insert(call.frame.value_or(0));
        }
    return wanted;
}

void take_note(PlayedRun& run, const Wanted& wanted, int frame, Picture picture)
{
    for (const int first : wanted.sequences) {
        if (frame < first)
            continue;
        PlayedSequence& sequence = run.sequences[first];
        if (const std::size_t bad = count_nonfinite(picture.linear))
            sequence.nonfinite += bad;
        else
            sequence.meter.add(picture.linear);
    }
    if (wanted.pictures.contains(frame))
        run.pictures[frame] = std::move(picture);
}

PlayedRun play_once(
    const Script& script, const Url& url, const Settings& settings, const Wanted& wanted)
{
    Session session(url, hello_for(script, settings));
    if (script.edits())
        session.edit(nlohmann::json::object(), /*reset=*/true);  // what the run before has left
    PlayedRun run;
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
        run.frames.push_back(facts_of(frame, picture));
        take_note(run, wanted, i, std::move(picture));
    }
    session.close();
    return run;
}

/// Plays the run again for what lies behind its last two frames.
std::vector<std::uint8_t> play_revealed(const Script& script, const Url& url, Settings settings)
{
    const int last = script.frames - 1;
    const auto pictures_of = [&](const char* view) {
        settings["view"] = view;
        return play_once(script, url, settings, {.pictures = {last - 1, last}}).pictures;
    };
    const std::map<int, Picture> depth = pictures_of("depth");
    const std::map<int, Picture> motion = pictures_of("motion");
    const Picture& now = depth.at(last);
    return newly_revealed(
        now.linear, motion.at(last).linear, depth.at(last - 1).linear, {now.width, now.height});
}

PlayedRun play_run(
    const Script& script, const Url& url, const Settings& settings, const Wanted& wanted)
{
    PlayedRun run = play_once(script, url, settings, wanted);
    if (wanted.twice)
        run.again = play_once(script, url, settings, {}).frames;
    if (wanted.revealed)
        run.revealed = play_revealed(script, url, settings);
    return run;
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
    Played played;
    for (const auto& [name, settings] : script.runs) {
        const Wanted wanted = wanted_of(script, name);
        progress(name + ": " + std::to_string(script.frames) + " frames"
            + (wanted.twice ? ", twice" : ""));
        try {
            played.runs[name] = play_run(script, url, merged(script.settings, settings), wanted);
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
