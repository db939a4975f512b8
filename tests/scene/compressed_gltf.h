// glTF files of a square whose mesh is compressed.
#pragma once

#include "tests/scene/gltf_builder.h"

namespace farlight {

/// One Draco primitive of two triangles, 4 positions (id 0) and texture coordinates (id 1), which
/// are the positions' x and y.
GltfBuilder draco_gltf();

/// Three meshopt views: positions by the exponential filter, normals by the octahedral one, and
/// indices as triangles or as a sequence.
GltfBuilder meshopt_gltf(bool as_sequence);

}  // namespace farlight
