// Triangle meshes written out in a Farlight scene document.
#pragma once

#include "server/scene/mesh_repair.h"
#include "server/scene/scene_error.h"

#include <nlohmann/json_fwd.hpp>

namespace farlight {

/// Throws SceneError for lists that do not fit together or a mesh without any triangle left.
Mesh read_inline_mesh(const nlohmann::json& value, const std::string& name, const ScenePlace& place,
    MeshRepairs& repairs);

/// unit_cube() with a whole picture on each face, upright on the four sides.
Mesh unit_cube_with_uvs();

}  // namespace farlight
