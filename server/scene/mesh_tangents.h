// Tangents for meshes whose file gives none.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

/// Fills mesh.tangents from how `uv_set` runs over the triangles: xyz the way u grows, orthogonal
/// to the normal if there is one; w tells which way v grows. A vertex between triangles of both
/// ways is doubled. Where uv says nothing, any direction orthogonal to the normal. Nothing if the
/// mesh lacks that set.
void add_tangents(Mesh& mesh, std::uint8_t uv_set);

/// The texture whose uv set a material's tangents follow; null if it has no normal map.
const Texture* normal_map(const Material& material);

}  // namespace farlight
