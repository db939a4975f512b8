// Materials as the GPU reads them.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

/// MATERIAL_TEXELS texels a material (shaders/shared/scene_layout.h).
std::vector<glm::uvec4> pack_materials(const std::vector<Material>& materials);

}  // namespace farlight
