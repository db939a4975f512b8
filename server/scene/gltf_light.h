// KHR_lights_punctual.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/scene.h"

namespace farlight {

struct GltfLightCounts {
    std::size_t clamped = 0;  ///< Numbers outside their range.
    std::size_t with_range = 0;  ///< Which is not read.
};

/// The document's light `index`, which check_gltf() found: at the origin, shining along -z.
PunctualLight read_gltf_light(
    const GltfContainer& gltf, const nlohmann::json& index, GltfLightCounts& counts);

/// `light` as `to_from` moves it; nothing where that leaves it no direction.
bool place_light(PunctualLight& light, const glm::dmat4& to_from);

}  // namespace farlight
