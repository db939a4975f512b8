// One glTF primitive -> Mesh.
#pragma once

#include "server/scene/mesh_repair.h"
#include "server/scene/scene_error.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace farlight {

/// Whether the primitive is made of triangles: a list, a strip or a fan.
bool has_triangles(const tinygltf::Primitive& primitive);

/// Reads a primitive with triangles and repairs it, counting into `repairs`. Throws SceneError for
/// an index out of range, or if no triangle is left.
Mesh read_gltf_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
    const ScenePlace& place, MeshRepairs& repairs);

}  // namespace farlight
