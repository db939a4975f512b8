// /timeline -> tracks: one for each quantity of each thing that an event changes.
#include "server/scene/mesh_repair.h"
#include "server/scene/scene_json_material.h"
#include "server/scene/scene_json_motion.h"
#include "server/scene/scene_json_values.h"
#include "server/scene/track_keys.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <tuple>

namespace farlight {

namespace {

using Json = nlohmann::json;

struct Event {
    const Json* value;
    ScenePlace place;
    double start;  // [s]
    double end;
};

glm::dquat turn(const glm::dvec3& degrees)
{
    const glm::dvec3 angles = glm::radians(degrees);
    return glm::angleAxis(angles.z, glm::dvec3(0, 0, 1))
        * glm::angleAxis(angles.y, glm::dvec3(0, 1, 0))
        * glm::angleAxis(angles.x, glm::dvec3(1, 0, 0));
}

std::vector<double> parts(const glm::dquat& q)
{
    return {q.x, q.y, q.z, q.w};
}

std::vector<double> parts(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

Track translation(const std::vector<Event>& events, std::uint32_t node, const glm::dvec3& rest)
{
    glm::dvec3 at = rest;
    TrackKeys keys(parts(at));
    for (const Event& event : events) {
        at += vec3((*event.value)["move"]);
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(at[axis]) <= kLargestCoordinate))
                refuse(event.place / "move", "a move beyond 1e11",
                    "coordinates of at most 1e11 in magnitude");
        if (event.end > event.start)
            keys.ramp(event.start, event.end, parts(at));
        else
            keys.step(event.start, parts(at));
    }
    return keys.finish(Track::Target::kTranslation, node);
}

/// In pieces of at most 90 degrees: between two keys a rotation takes the shorter way.
Track rotation_track(const std::vector<Event>& events, std::uint32_t node)
{
    glm::dquat before(1, 0, 0, 0);
    TrackKeys keys(parts(before));
    for (const Event& event : events) {
        const glm::dvec3 angles = vec3((*event.value)["rotate_degrees"]);
        const glm::dvec3 size = glm::abs(angles);
        const int pieces =
            std::max(1, static_cast<int>(std::ceil(std::max({size.x, size.y, size.z}) / 90)));
        if (event.end > event.start)
            for (int i = 1; i <= pieces; ++i) {
                const double begin = std::lerp(event.start, event.end, (i - 1.0) / pieces);
                const double end = std::lerp(event.start, event.end, 1.0 * i / pieces);
                if (end > begin)  // else more pieces than the clock can tell apart
                    keys.ramp(begin, end, parts(turn(angles * (1.0 * i / pieces)) * before));
            }
        else
            keys.step(event.start, parts(turn(angles) * before));
        before = glm::normalize(turn(angles) * before);
    }
    return keys.finish(Track::Target::kRotation, node);
}

/// A factor on what the scene says: /intensity sets it, /on takes it to 0 and back.
Track factor(const std::vector<Event>& events, Track::Target target, std::uint32_t index)
{
    double intensity = 1;
    bool on = true;
    TrackKeys keys({1});
    for (const Event& event : events) {
        intensity = event.value->value("intensity", intensity);
        on = event.value->value("on", event.value->contains("intensity") || on);
        const std::vector<double> value{on ? intensity : 0};
        if (event.end > event.start)
            keys.ramp(event.start, event.end, value);
        else
            keys.step(event.start, value);
    }
    return keys.finish(target, index);
}

class Timeline {
public:
    Timeline(const SceneMotion& motion, const SceneMaterials& materials, Scene& scene)
        : motion_(motion)
        , materials_(materials)
        , scene_(scene)
    {
    }

    void read(const Json& events, const ScenePlace& place);

private:
    enum class Quantity { kPlace, kRotation, kFactor };
    struct Subject {
        std::string kind;  // "object", "light", ...
        std::string name;
        Quantity quantity;
        bool operator<(const Subject& other) const
        {
            return std::tie(kind, name, quantity)
                < std::tie(other.kind, other.name, other.quantity);
        }
    };

    static Subject subject_of(const Json& event, const ScenePlace& place);
    static void check_order(const std::vector<Event>& events);
    Track track_of(const Subject& subject, const std::vector<Event>& events) const;
    Track factor_of(const Subject& subject, const std::vector<Event>& events) const;

    const SceneMotion& motion_;
    const SceneMaterials& materials_;
    Scene& scene_;
};

void Timeline::read(const Json& events, const ScenePlace& place)
{
    std::map<Subject, std::vector<Event>> by_subject;
    for (std::size_t i = 0; i < events.size(); ++i) {
        const double start = events[i]["at"].get<double>();
        by_subject[subject_of(events[i], place / i)].push_back(
            {&events[i], place / i, start, start + events[i].value("over", 0.0)});
    }
    for (auto& [subject, list] : by_subject) {
        std::stable_sort(list.begin(), list.end(),
            [](const Event& a, const Event& b) { return a.start < b.start; });
        check_order(list);
        scene_.animation.tracks.push_back(track_of(subject, list));
    }
}

Timeline::Subject Timeline::subject_of(const Json& event, const ScenePlace& place)
{
    const bool moves = event.contains("move") || event.contains("rotate_degrees");
    Subject subject{"background", "", Quantity::kFactor};
    for (const char* const kind : {"object", "light", "material"})
        if (event.contains(kind))
            subject = {kind, event[kind].get<std::string>(), Quantity::kFactor};
    if (subject.kind == "object" && !moves)
        refuse(place, "an object that is switched or dimmed",
            "move or rotate_degrees; its light "
            "is its material's");
    if ((subject.kind == "material" || subject.kind == "background") && moves)
        refuse(place, "a " + subject.kind + " that moves", "on or intensity");
    if (moves)
        subject.quantity = event.contains("move") ? Quantity::kPlace : Quantity::kRotation;
    return subject;
}

void Timeline::check_order(const std::vector<Event>& events)
{
    for (std::size_t i = 1; i < events.size(); ++i)
        if (!(events[i].start >= events[i - 1].end && events[i].start > events[i - 1].start))
            refuse(events[i].place / "at", (*events[i].value)["at"].dump() + " s",
                "a time after " + events[i - 1].place.pointer + ", which changes the same until "
                    + Json(events[i - 1].end).dump() + " s");
}

Track Timeline::track_of(const Subject& subject, const std::vector<Event>& events) const
{
    if (subject.quantity == Quantity::kFactor)
        return factor_of(subject, events);
    const std::uint32_t node = motion_.node_of({subject.kind, subject.name}, events.front().place);
    return subject.quantity == Quantity::kPlace
        ? translation(events, node, scene_.animation.nodes[node].translation)
        : rotation_track(events, node);
}

Track Timeline::factor_of(const Subject& subject, const std::vector<Event>& events) const
{
    if (subject.kind == "background")
        return factor(events, Track::Target::kBackground, 0);
    if (subject.kind == "material")
        return factor(events, Track::Target::kMaterialEmission,
            materials_.at(subject.name, events.front().place / "material"));
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < scene_.lights.size(); ++i) {
        if (scene_.lights[i].name == subject.name)
            return factor(events, Track::Target::kLightIntensity, i);
        names.push_back(scene_.lights[i].name);
    }
    refuse(events.front().place / "light", "the unknown light " + in_quotes(subject.name),
        one_of(names, "/lights"));
}

}  // namespace

void read_timeline(const Json& document, const ScenePlace& root, const SceneMotion& motion,
    const SceneMaterials& materials, Scene& scene)
{
    if (document.contains("timeline"))
        Timeline(motion, materials, scene).read(document["timeline"], root / "timeline");
}

}  // namespace farlight
