// Whether a glTF document's references and byte ranges hold, before anything follows them.
#pragma once

#include "server/scene/gltf_container.h"

namespace farlight {

/// The document fits the glTF schema. Throws SceneError for an index out of range, whether the
/// scene that is shown needs it or not, nodes that form no trees, bytes outside their buffer,
/// accessors that cannot be what attributes and indices want. What materials name is left to their
/// reader, who reads them all.
void check_gltf(const GltfContainer& gltf);

/// The part of it for all indices but those of meshes, accessors and buffer views.
void check_gltf_references(const GltfContainer& gltf);

/// The part of it for one mesh, whose accessors' ranges are checked elsewhere.
void check_gltf_mesh(
    const GltfContainer& gltf, const nlohmann::json& mesh, const ScenePlace& place);

}  // namespace farlight
