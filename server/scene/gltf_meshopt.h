// EXT_meshopt_compression: buffer views that are kept compressed.
#pragma once

#include "server/scene/scene_error.h"

#include <nlohmann/json.hpp>
#include <span>

namespace farlight {

/// `meshopt` is the extension's object, found at `place`. Throws SceneError if count, stride, mode
/// and filter do not go together, or cannot come from so few bytes.
void check_gltf_meshopt(const nlohmann::json& meshopt, const ScenePlace& place);

/// count * byteStride bytes out of `packed`. Throws SceneError if they cannot be decoded.
std::string unpack_gltf_meshopt(
    const nlohmann::json& meshopt, std::span<const unsigned char> packed, const ScenePlace& place);

}  // namespace farlight
