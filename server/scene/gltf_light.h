// KHR_lights_punctual.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/scene.h"

namespace farlight {

/// The document's light `index`, found at `place`: at the origin, shining along -z. What had to be
/// changed is counted into `changed`. Throws SceneError.
PunctualLight read_gltf_light(const GltfContainer& gltf, const nlohmann::json& index,
    const ScenePlace& place, std::size_t& changed);

/// `light` as `to_from` moves it; nothing where that leaves it no direction.
bool place_light(PunctualLight& light, const glm::dmat4& to_from);

}  // namespace farlight
