// KHR_draco_mesh_compression: attributes and indices that a primitive keeps compressed.
#pragma once

#include "server/scene/gltf_container.h"

namespace farlight {

/// Decodes the primitive's part, if it has one, into gltf.unpacked for the accessors that it
/// stands for. Throws SceneError at `place` for bytes that cannot be decoded or are not what the
/// accessors say.
void unpack_gltf_draco(
    GltfContainer& gltf, const nlohmann::json& primitive, const ScenePlace& place);

}  // namespace farlight
