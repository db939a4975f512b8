// Materials as the GPU reads them.
#pragma once

#include "server/scene/scene.h"
#include "server/scene/texels.h"
#include "server/scene/textures.h"

namespace farlight {

/// MATERIAL_TEXELS texels a material (shaders/shared/scene_layout.h).
/// `textures` is laid out for them.
Texels pack_materials(const std::vector<Material>& materials, const TextureLayout& textures);

/// Whether a lobe of any is neither diffuse nor a mirror, so that the albedo table is read.
bool scatters_roughly(const std::vector<Material>& materials);

}  // namespace farlight
