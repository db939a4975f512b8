// Script files: reading and checking.
#include "client/script/script.h"

#include <algorithm>

namespace farlight::client {
namespace {

constexpr int kMaxFrames = 100'000;
constexpr double kMaxDegrees = 36'000;

Settings settings_in(const JsonInput& input)
{
    Settings settings;
    for (const auto& [key, value] : input.members()) {
        if (!value.value().is_primitive() || value.value().is_null())
            value.fail("a string, number or boolean");
        settings[key] = value.value();
    }
    return settings;
}

CameraMove camera_in(const JsonInput& input)
{
    if (input.value() == "rest")
        return RestMove{};
    if (!input.value().is_object() || input.value().size() != 1)
        input.fail("\"rest\" or an object with one of orbit, path, keyframes");
    input.expect_object({"orbit", "path", "keyframes"});
    if (const auto turn = input.find("orbit")) {
        turn->expect_object({"degrees", "from"});
        OrbitMove move{.degrees = turn->at("degrees").number(-kMaxDegrees, kMaxDegrees)};
        if (const auto from = turn->find("from"))
            move.from = from->number(-kMaxDegrees, kMaxDegrees);
        return move;
    }
    if (const auto path = input.find("path"))
        return NamedPathMove{path->string()};
    return KeyframeMove{read_keyframes(input.at("keyframes"))};
}

std::vector<ScriptEvent> events_in(const JsonInput& input, int frames)
{
    std::vector<ScriptEvent> events;
    for (const JsonInput& element : input.elements()) {
        element.expect_object({"frame", "set", "edit", "cut"});
        ScriptEvent event{.frame = element.at("frame").integer(0, frames - 1)};
        if (const auto set = element.find("set"))
            event.set = settings_in(*set);
        if (const auto edit = element.find("edit")) {
            if (!edit->value().is_object())
                edit->fail("an object, a JSON Merge Patch of the scene");
            event.edit = edit->value();
        }
        if (const auto cut = element.find("cut"))
            event.cut = cut->boolean();
        if (event.set.empty() && event.edit.is_null() && !event.cut)
            element.fail("an event that does nothing", "set, edit or cut");
        if (!events.empty() && event.frame < events.back().frame)
            element.at("frame").fail("events in the order of their frames");
        events.push_back(event);
    }
    return events;
}

std::map<std::string, Settings> runs_in(const JsonInput& input)
{
    std::map<std::string, Settings> runs;
    for (const auto& [name, settings] : input.members()) {
        const bool plain = !name.empty()
            && std::all_of(name.begin(), name.end(),
                [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
        if (!plain)
            settings.fail("the run name '" + name + "'", "letters, digits and underscores");
        runs[name] = settings_in(settings);
    }
    if (runs.empty())
        input.fail("at least one run");
    return runs;
}

Reference reference_in(const JsonInput& input)
{
    input.expect_object({"samples", "settings"});
    Reference reference{.samples = input.at("samples").integer(1, 10'000'000)};
    if (const auto settings = input.find("settings"))
        reference.settings = settings_in(*settings);
    return reference;
}

/// Every run and frame an expectation speaks of exists.
void check_calls(const JsonInput& input, const Expectation& expectation, const Script& script)
{
    for (const Call& call : calls_in(expectation)) {
        const std::string function(call.function->name);
        if (!call.run.empty() && !script.runs.contains(call.run))
            input.fail("the unknown run '" + call.run + "'", "one of /runs");
        if (call.frame && (*call.frame < 0 || *call.frame >= script.frames))
            input.fail("frame " + std::to_string(*call.frame),
                "0 to " + std::to_string(script.frames - 1));
        const bool one_frame = script.frames - call.frame.value_or(0) < 2;
        if (call.function->of == Of::kFramesFrom && one_frame)
            input.fail("'" + function + "' of one frame", "2 frames or more");
        if (!call.function->needs_reference)
            continue;
        if (!script.reference)
            input.fail("'" + function + "' but no /reference", "a reference to compare with");
        // The reference shows the last frame's view.
        const Of of = call.function->of;
        const bool before_last = of == Of::kFramesFrom
            || (of == Of::kFrame && call.frame.value_or(script.frames - 1) != script.frames - 1);
        if (before_last && !std::holds_alternative<RestMove>(script.camera))
            input.fail("'" + function + "' of a frame before the last with a moving camera",
                "the last frame, which the reference shows");
        if (function == "ghost" && script.frames < 2)
            input.fail("'ghost' of one frame", "2 frames or more");
        if (of == Of::kAllRuns && script.runs.size() < 2)
            input.fail("'" + function + "' of one run", "2 runs or more, with different seeds");
    }
}

std::vector<Expectation> expectations_in(const JsonInput& input, const Script& script)
{
    std::vector<Expectation> expectations;
    for (const JsonInput& element : input.elements()) {
        try {
            expectations.push_back(parse_expectation(element.string()));
        } catch (const ExpressionError& problem) {
            element.fail(problem.what(), "an expectation");
        }
        check_calls(element, expectations.back(), script);
    }
    if (expectations.empty())
        input.fail("at least one expectation");
    return expectations;
}

}  // namespace

Script parse_script(const JsonInput& input)
{
    input.expect_object({"about", "scene", "size", "frames", "camera", "settings", "events", "runs",
        "reference", "expect"});
    Script script;
    script.file = input.file();
    if (const auto about = input.find("about"))
        about->string();
    script.scene = script.file.parent_path() / input.at("scene").string();
    if (const auto size = input.find("size")) {
        const auto sides = size->elements();
        if (sides.size() != 2)
            size->fail("an array of width and height");
        script.size = {static_cast<std::uint32_t>(sides[0].integer(1, 65535)),
            static_cast<std::uint32_t>(sides[1].integer(1, 65535))};
    }
    if (const auto frames = input.find("frames"))
        script.frames = frames->integer(1, kMaxFrames);
    if (const auto camera = input.find("camera"))
        script.camera = camera_in(*camera);
    if (const auto settings = input.find("settings"))
        script.settings = settings_in(*settings);
    if (const auto events = input.find("events"))
        script.events = events_in(*events, script.frames);
    const auto runs = input.find("runs");
    script.runs = runs ? runs_in(*runs) : std::map<std::string, Settings>{{"run", {}}};
    if (const auto reference = input.find("reference"))
        script.reference = reference_in(*reference);
    script.expectations = expectations_in(input.at("expect"), script);
    return script;
}

bool Script::edits() const
{
    return std::any_of(events.begin(), events.end(),
        [](const ScriptEvent& event) { return !event.edit.is_null(); });
}

Script read_script(const std::filesystem::path& file)
{
    return parse_script(JsonInput::read(file));
}

Pose pose_of(const Script& script, const protocol::Welcome& welcome, int frame)
{
    if (const auto* move = std::get_if<OrbitMove>(&script.camera))
        return orbit(welcome.camera, middle_of(welcome.scene),
            move->from + orbit_angle(move->degrees, frame, script.frames));
    if (const auto* move = std::get_if<KeyframeMove>(&script.camera))
        return pose_at(move->keyframes, frame);
    if (const auto* move = std::get_if<NamedPathMove>(&script.camera)) {
        const auto path = welcome.camera_paths.find(move->name);
        if (path == welcome.camera_paths.end() || path->second.empty())
            throw InputError(script.file.string() + ": /camera/path: found '" + move->name
                + "', expected a camera path of the scene " + welcome.scene.name);
        return pose_at(path->second, frame);
    }
    return welcome.camera;
}

}  // namespace farlight::client
