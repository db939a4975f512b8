// Bytes of a scene file of each kind, loaded as the server would.
#pragma once

#include "server/scene/scene.h"

#include <string>
#include <string_view>

namespace farlight {

enum class SceneFormat : std::uint8_t { kJson, kGltf, kGlb };

/// "loaded" or "refused" (a SceneError, or a GlError of what no device holds), or else what a scene
/// that loaded breaks of load_scene()'s promise. A scene that loads and is not large is packed as
/// for a device too. Other exceptions go through: none should come.
std::string load_input(SceneFormat format, std::string_view bytes);

/// What the scene breaks of the promise that its numbers are finite, its indices in range and its
/// lists as long as they should be; empty if nothing.
std::string broken_promise(const Scene& scene);

}  // namespace farlight
