// Timeline events for lamps, and frames while time passes.
#include "client/accuracy/moving_light.h"

#include "client/metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace farlight::client {
namespace {

using nlohmann::json;
using Vector = std::array<double, 3>;

/// A frame's time [s]; exact in binary, so that moments of references and frames are the same.
constexpr double kTimeStep = 1.0 / 32;
/// How far a lamp leaves its surface (a ceiling), of its width.
constexpr double kOff = 0.5;

Vector scaled(const Vector& v, double by)
{
    return {v[0] * by, v[1] * by, v[2] * by};
}

Vector sum_of(const Vector& a, const Vector& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double length(const Vector& v)
{
    return std::hypot(v[0], v[1], v[2]);
}

/// Of the direction of `v`, `long_as` long; none where `v` has no direction.
Vector directed(const Vector& v, double long_as)
{
    const double size = length(v);
    return size > 0 ? scaled(v, long_as / size) : Vector{};
}

bool emits(const json& document, const json& object)
{
    const json& materials = document.value("materials", json::object());
    const auto material = materials.find(object.value("material", ""));
    if (material == materials.end() || !material->contains("emission"))
        return false;
    const json& emission = material->at("emission");
    return std::any_of(emission.begin(), emission.end(),
        [](const json& channel) { return channel.is_number() && channel.get<double>() > 0; });
}

/// Along the lamp's own surface and off it; towards the middle where it has no side.
std::optional<Vector> move_of(const json& object, const Vector& middle)
{
    if (object.contains("quad")) {
        const Vector u = object["quad"].at("edge_u");
        const Vector v = object["quad"].at("edge_v");
        return sum_of(u, directed(cross(u, v), kOff * length(u)));
    }
    if (object.contains("disk")) {
        const double width = 2 * object["disk"].at("radius").get<double>();
        const Vector normal = object["disk"].at("normal");
        const Vector axis =
            std::abs(normal[0]) < std::abs(normal[1]) ? Vector{1, 0, 0} : Vector{0, 1, 0};
        return sum_of(directed(cross(normal, axis), width), directed(normal, kOff * width));
    }
    if (object.contains("sphere")) {
        const Vector center = object["sphere"].at("center");
        return directed(
            sum_of(middle, scaled(center, -1)), 2 * object["sphere"].at("radius").get<double>());
    }
    return {};
}

json event_of(const char* kind, const std::string& name, const Vector& move, int frames)
{
    return {{"at", 0}, {"over", frames * kTimeStep}, {kind, name}, {"move", move}};
}

/// Events of the objects that emit. Those of a list are told apart by names, which they are given
/// where they have none.
void move_objects(const json& document, LightMotion& motion, const Vector& middle, json& events)
{
    json objects = document.value("objects", json::array());
    bool named = false;
    std::size_t at = 0;
    for (auto& [key, object] : objects.items()) {
        const auto move = emits(document, object) ? move_of(object, middle) : std::nullopt;
        ++at;
        if (!move)
            continue;
        if (objects.is_array() && !object.contains("name")) {
            object["name"] = "lamp, object " + std::to_string(at);
            named = true;
        }
        events.push_back(event_of("object",
            objects.is_array() ? object["name"].get<std::string>() : key, *move, motion.frames));
    }
    if (named)
        motion.patch["objects"] = objects;
}

void move_lights(
    const json& document, const LightMotion& motion, const Vector& middle, json& events)
{
    const json lights = document.value("lights", json::object());
    for (const auto& [name, light] : lights.items())
        for (const char* kind : {"point", "spot"})
            if (light.contains(kind)) {
                const Vector from = light[kind].at("position");
                const Vector way = scaled(sum_of(middle, scaled(from, -1)), 0.25);
                events.push_back(event_of("light", name, way, motion.frames));
            }
}

std::filesystem::path folder_of(const std::filesystem::path& folder, std::size_t moment)
{
    return folder / ("moment_" + std::to_string(moment));
}

}  // namespace

LightMotion motion_of_lamps(const json& document, const std::array<double, 3>& middle, int frames)
{
    LightMotion motion{.what = "", .patch = {}, .frames = frames};
    if (!document.is_object())
        return motion;
    json events = document.value("timeline", json::array());
    const std::size_t before = events.size();
    move_objects(document, motion, middle, events);
    const std::size_t objects = events.size();
    if (objects > before)
        motion.what = "every lamp with a surface moves by about its own width";
    move_lights(document, motion, middle, events);
    if (events.size() > objects)
        motion.what += std::string(motion.what.empty() ? "" : " and ")
            + "every point and spot light moves a quarter of the way to the scene's middle";
    if (events.size() > before)
        motion.patch["timeline"] = events;
    return motion;
}

MovingReference draw_moving_reference(Rig& rig, const ReferencePlan& plan,
    const LightMotion& motion, const std::filesystem::path& folder, Progress& progress)
{
    MovingReference truth;
    for (std::size_t moment = 0; moment <= static_cast<std::size_t>(motion.frames); ++moment) {
        const std::filesystem::path place = folder_of(folder, moment);
        std::filesystem::create_directories(place);
        rig.choose({{"time", static_cast<double>(moment) * kTimeStep}});
        truth.push_back(draw_reference(rig, plan, place, progress));
        truth.back().variance.clear();  // a picture for each moment is enough
    }
    rig.choose({{"time", 0}});
    return truth;
}

void remove_moving_reference(const std::filesystem::path& folder)
{
    for (std::size_t moment = 0; std::filesystem::exists(folder_of(folder, moment)); ++moment)
        remove_batches(folder_of(folder, moment));
}

double work_of_motion(const SweepPoint& point, const ResponsePlan& plan, int frames)
{
    return work_of(point.settings) * plan.seeds * (1 + plan.history + frames + plan.after);
}

json measure_motion(
    Rig& rig, const SweepPoint& point, const ResponsePlan& plan, const MovingReference& truth)
{
    const std::size_t moving = truth.size() - 1;
    rig.choose(plan.settings);
    rig.choose(point.settings);
    rig.choose({{"time_step", kTimeStep}});
    double flicker = 0;
    std::vector<double> errors(moving + static_cast<std::size_t>(plan.after));
    for (int seed = 1; seed <= plan.seeds; ++seed) {
        rig.choose({{"seed", seed}, {"time", 0}, {"play", false}});
        for (int i = 0; i < plan.history; ++i)
            rig.draw(/*cut=*/i == 0);
        rig.choose({{"play", true}});  // time passes after a frame: the next one is of moment 0
        FlickerMeter meter;
        for (std::size_t moment = 0; moment < truth.size(); ++moment) {
            const Picture picture = linear_picture(rig.draw());
            const ReferencePicture& now = truth[moment];
            meter.add(picture.linear, now.mean);
            if (moment > 0)
                errors[moment - 1] +=
                    relative_mse(picture.linear, now.mean, now.counts) / plan.seeds;
        }
        flicker += meter.flicker(truth.front().counts) / plan.seeds;
        rig.choose({{"play", false}, {"time", static_cast<double>(moving) * kTimeStep}});
        const ReferencePicture& last = truth.back();
        for (std::size_t i = moving; i < errors.size(); ++i)
            errors[i] += relative_mse(linear_picture(rig.draw()).linear, last.mean, last.counts)
                / plan.seeds;
    }
    return {{"flicker", flicker}, {"errors", errors},
        {"lag", lag_frames(std::span(errors).subspan(moving))}};
}

}  // namespace farlight::client
