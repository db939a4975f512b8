// Elements of a glTF accessor, whatever their component type, stride and sparse overlay.
#pragma once

#include "server/scene/gltf_container.h"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace farlight {

/// For an accessor that check_gltf() passed. Element is float, glm::vec2 to vec4 or glm::mat4, and
/// the accessor's type has as many components; normalized integers become [0, 1] or [-1, 1]. Or
/// Element is uint32_t or glm::u16vec4, and the components are integers that it can hold.
template <typename Element>
std::vector<Element> read_accessor(const GltfContainer& gltf, const nlohmann::json& index);

}  // namespace farlight
