// Elements of a glTF accessor, whatever their component type, stride and sparse overlay.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace tinygltf {
class Model;
}

namespace farlight {

/// For an accessor that check_gltf() passed as POSITION or NORMAL.
std::vector<glm::vec3> read_vectors(const tinygltf::Model& model, int accessor);

/// For an accessor that check_gltf() passed as indices.
std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, int accessor);

}  // namespace farlight
