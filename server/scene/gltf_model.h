// A checked glTF document and its bytes -> tinygltf's model.
#pragma once

#include "server/scene/gltf_container.h"

#include <string>

namespace tinygltf {
class Model;
}

namespace farlight {

/// tinygltf sees only the parts that were checked, and reads no file. Throws SceneError for a data
/// URI that cannot be decoded.
tinygltf::Model to_tinygltf(const GltfContainer& container, const std::string& file);

}  // namespace farlight
