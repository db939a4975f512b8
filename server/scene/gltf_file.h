// glTF 2.0 (.gltf, .glb) -> Scene. Read gltf_file.cpp for the order; gltf_extensions.cpp lists
// which extensions are read.
#pragma once

#include "server/scene/scene.h"

#include <filesystem>

namespace farlight {

struct GltfScene {
    Scene scene;  ///< All objects are MeshInstances.
    bool has_camera = false;  ///< Otherwise scene.camera says nothing.
};

/// Throws SceneError.
GltfScene load_gltf(const std::filesystem::path& file);

/// The same for a file already in memory; other files that it names lie beside `file`.
GltfScene parse_gltf(std::string bytes, const std::filesystem::path& file);

/// Whether the extension is one of a glTF file, whatever its case.
bool is_gltf(const std::filesystem::path& file);

}  // namespace farlight
