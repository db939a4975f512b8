// A Farlight scene document, version 1 -> Scene.
#pragma once

#include "server/scene/scene_files.h"

#include <nlohmann/json_fwd.hpp>

namespace farlight {

struct SceneSource {
    std::string name;  ///< Stands for the document's file in errors.
    bool is_gltf = false;  ///< The document was made for one glTF file: it gets a default light.
};

/// `document` is any JSON; it is checked against the schema first. Throws SceneError.
Scene scene_from_json(const nlohmann::json& document, const SceneSource& source, SceneFiles& files);

/// Throws SceneError where objects at time 0 reach beyond 1e11, or overflow on the way.
void check_extent(const Scene& scene);

}  // namespace farlight
