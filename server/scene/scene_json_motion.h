// What moves in a Farlight scene document: the nodes that carry objects and lights, /spin, and
// /timeline.
#pragma once

#include "server/scene/gltf_instances.h"

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <utility>

namespace farlight {

class SceneMaterials;

/// An object or a light of the document; "object" or "light", and its name.
using Mover = std::pair<std::string, std::string>;

class SceneMotion {
public:
    /// Looks through the timeline for what it moves.
    SceneMotion(const nlohmann::json& document, Scene& scene);

    /// The node for `mover`, whose own centre is at `center`; none if it rests. `value` is its part
    /// of the document, which may have a /spin.
    Carrier carrier_of(const Mover& mover, const nlohmann::json& value, const glm::dvec3& center,
        const ScenePlace& place);

    /// The node that the timeline moves. Refuses a mover that is not there.
    std::uint32_t node_of(const Mover& mover, const ScenePlace& place) const;

private:
    Carrier add_spin(const nlohmann::json& spin, const std::string& name, const Carrier& outer,
        const glm::dvec3& center, const ScenePlace& place);

    Scene& scene_;
    std::set<Mover> moved_;  // by the timeline
    std::map<Mover, std::uint32_t> nodes_;
    std::map<std::string, std::vector<std::string>> names_;  // of all objects, of all lights
};

/// Turns /timeline into tracks, after everything else has been read.
void read_timeline(const nlohmann::json& document, const ScenePlace& root,
    const SceneMotion& motion, const SceneMaterials& materials, Scene& scene);

}  // namespace farlight
