// glTF materials -> diffuse and emissive ones.
#pragma once

#include "server/scene/scene.h"

namespace tinygltf {
class Model;
}

namespace farlight {

/// One Material for each of the model's, in its order. What had to be changed goes to `notes`.
std::vector<Material> read_gltf_materials(
    const tinygltf::Model& model, std::vector<std::string>& notes);

}  // namespace farlight
