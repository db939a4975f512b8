// File -> Scene: Farlight scene JSON v1 (scenes/schema/farlight-scene.schema.json) or glTF 2.0.
#pragma once

#include "server/scene/scene.h"

#include <filesystem>
#include <stdexcept>

namespace farlight {

/// A scene file that cannot be used. what() reads
/// `FILE: /json/pointer: found X, expected Y`.
struct SceneError : std::runtime_error {
    using std::runtime_error::runtime_error;
    std::string pointer;  ///< JSON pointer of the value at fault; empty: the whole file.
};

/// Loads `.json`, `.gltf` or `.glb`, chosen by extension. Throws SceneError.
/// Every number in the result is finite, every index in range, every mesh has at least one
/// triangle, no triangle has zero area (dropped ones are counted in Scene::notes).
Scene load_scene(const std::filesystem::path& file);

/// The same for Farlight JSON already in memory; relative glTF paths start at `base_dir`.
/// `name` stands for the file in error messages.
Scene parse_scene(
    std::string_view json_text, const std::filesystem::path& base_dir, const std::string& name);

}  // namespace farlight
