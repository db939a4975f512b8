// glTF animations -> tracks: all of a file's clips play at once, each round by its own length.
#pragma once

#include "server/scene/gltf_rig.h"

#include <functional>

namespace farlight {

/// Indices of the objects that a node of the document became.
using ObjectsOfNode = std::map<std::size_t, std::vector<std::uint32_t>>;

/// Appends to scene.animation.tracks; what was left out or repaired goes to scene.notes. Throws
/// SceneError for samplers that do not fit their channel and for times that do not increase.
void read_gltf_animations(
    const GltfContainer& gltf, const GltfRig& rig, const ObjectsOfNode& objects, Scene& scene);

}  // namespace farlight
