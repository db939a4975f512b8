// Whether a glTF document's references and byte ranges hold, before anything follows them.
#pragma once

#include "server/scene/gltf_container.h"

namespace farlight {

/// The document fits the glTF schema. Throws SceneError for an index out of range, bytes outside
/// their buffer, accessors that cannot be what attributes and indices want. Cycles among nodes are
/// left to whoever walks them, and what only materials, skins and animations name to their readers.
void check_gltf(const GltfContainer& gltf);

/// The part of it for one mesh, whose accessors' ranges are checked elsewhere.
void check_gltf_mesh(
    const GltfContainer& gltf, const nlohmann::json& mesh, const ScenePlace& place);

}  // namespace farlight
