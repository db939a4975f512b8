// One glTF primitive -> Mesh.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/mesh_repair.h"

namespace farlight {

/// Whether the primitive is made of triangles: a list, a strip or a fan.
bool has_triangles(const nlohmann::json& primitive);

/// Reads a primitive with triangles and repairs it, counting into `repairs`. Throws SceneError for
/// an index out of range, or if no triangle is left.
Mesh read_gltf_primitive(const GltfContainer& gltf, const nlohmann::json& primitive,
    const ScenePlace& place, MeshRepairs& repairs);

}  // namespace farlight
