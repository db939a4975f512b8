// Whether a glTF document's references and byte ranges hold, before anything follows them.
#pragma once

#include "server/scene/scene_error.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace farlight {

/// `document` fits the glTF schema. Throws SceneError for an index out of range, bytes outside
/// their buffer, accessors that cannot be positions, normals or indices, or a required extension
/// we lack. Cycles among nodes are left to whoever walks them.
void check_gltf(const nlohmann::json& document, const std::string& file);

/// Extensions that the file uses, may do without, and we do not read.
std::vector<std::string> unread_gltf_extensions(const nlohmann::json& document);

}  // namespace farlight
