// Bytes of a glTF file's buffer views.
#pragma once

#include "server/scene/gltf_container.h"

namespace farlight {

/// Fills gltf.views, once check_gltf() has passed.
void read_gltf_views(GltfContainer& gltf);

}  // namespace farlight
