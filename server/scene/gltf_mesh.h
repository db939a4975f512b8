// One glTF primitive -> Mesh.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/mesh_repair.h"

namespace farlight {

/// Whether the primitive is made of points or lines.
bool has_strokes(const nlohmann::json& primitive);

/// Reads a primitive and repairs it, counting into `repairs`. Throws SceneError for
/// an index out of range, or if no triangle is left.
Mesh read_gltf_primitive(const GltfContainer& gltf, const nlohmann::json& primitive,
    const ScenePlace& place, MeshRepairs& repairs);

}  // namespace farlight
