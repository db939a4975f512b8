// A node rests where its object's centre does; what it carries lies around its origin.
#include "server/scene/scene_json_motion.h"

#include "server/scene/scene_json_values.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace farlight {

namespace {

using Json = nlohmann::json;

std::uint32_t add_node(
    Scene& scene, const std::string& name, const Carrier& parent, const glm::dvec3& origin)
{
    Node node{.name = name, .parent = parent.node};
    node.translation = origin - parent.origin;
    scene.animation.nodes.push_back(std::move(node));
    return static_cast<std::uint32_t>(scene.animation.nodes.size() - 1);
}

/// One turn in quarters: between two keys a rotation takes the shorter way.
Track full_turn(std::uint32_t node, const glm::dvec3& axis, double period)
{
    Track track{.target = Track::Target::kRotation, .index = node, .period = period};
    for (int quarter = 0; quarter <= 4; ++quarter) {
        const glm::dquat turn = glm::angleAxis(quarter * std::numbers::pi / 2, axis);
        track.times.push_back(quarter * period / 4);
        for (const double part : {turn.x, turn.y, turn.z, turn.w})
            track.values.push_back(static_cast<float>(part));
    }
    return track;
}

}  // namespace

SceneMotion::SceneMotion(const Json& document, Scene& scene) : scene_(scene)
{
    if (!document.contains("timeline"))
        return;
    for (const Json& event : document["timeline"])
        for (const char* const kind : {"object", "light"})
            if (event.contains(kind)
                && (event.contains("move") || event.contains("rotate_degrees")))
                moved_.insert({kind, event[kind].get<std::string>()});
}

Carrier SceneMotion::carrier_of(
    const Mover& mover, const Json& value, const glm::dvec3& center, const ScenePlace& place)
{
    names_[mover.first].push_back(mover.second);
    Carrier carrier;
    if (moved_.contains(mover)) {
        if (nodes_.contains(mover))
            refuse(place, "a second " + mover.first + " called " + in_quotes(mover.second),
                "one of that name, because /timeline moves it");
        carrier = {add_node(scene_, mover.second, {}, center), center};
        nodes_[mover] = carrier.node;
    }
    if (value.contains("spin"))
        carrier = add_spin(value["spin"], mover.second, carrier, center, place / "spin");
    return carrier;
}

Carrier SceneMotion::add_spin(const Json& spin, const std::string& name, const Carrier& outer,
    const glm::dvec3& center, const ScenePlace& place)
{
    const glm::dvec3 axis = direction_or(spin, "axis", {0, 1, 0}, place);
    const glm::dvec3 origin = vec3_or(spin, "center", center);
    const Carrier carrier{add_node(scene_, name + " (spin)", outer, origin), origin};
    scene_.animation.tracks.push_back(full_turn(carrier.node, axis, spin["period"].get<double>()));
    return carrier;
}

std::uint32_t SceneMotion::node_of(const Mover& mover, const ScenePlace& place) const
{
    const auto found = nodes_.find(mover);
    if (found != nodes_.end())
        return found->second;
    const auto names = names_.find(mover.first);
    refuse(place / mover.first, "the unknown " + mover.first + " " + in_quotes(mover.second),
        one_of(names == names_.end() ? std::vector<std::string>{} : names->second,
            "/" + mover.first + "s"));
}

}  // namespace farlight
