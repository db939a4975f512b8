// Which glTF extensions are read.
#pragma once

#include "server/scene/scene_error.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace farlight {

/// Throws SceneError if the document requires one that is not read.
void check_gltf_extensions(const nlohmann::json& document, const ScenePlace& root);

/// Extensions that the file uses, may do without, and we do not read.
std::vector<std::string> unread_gltf_extensions(const nlohmann::json& document);

}  // namespace farlight
