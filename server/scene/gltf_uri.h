// Bytes that a glTF file names by a uri: a file beside it, or a data URI.
#pragma once

#include "server/scene/scene_error.h"

#include <filesystem>

namespace farlight {

/// Throws SceneError at `place` for a uri that is neither, a file that is missing, or data that is
/// not base64.
std::string read_gltf_uri(
    const std::string& uri, const std::filesystem::path& folder, const ScenePlace& place);

}  // namespace farlight
