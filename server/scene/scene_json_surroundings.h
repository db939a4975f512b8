// /background, /environment, /fog, /camera, /camera_paths, /settings of a Farlight scene document.
#pragma once

#include "server/scene/scene_files.h"

#include <nlohmann/json_fwd.hpp>

namespace farlight {

void read_environment(
    const nlohmann::json& document, const ScenePlace& root, SceneFiles& files, Scene& scene);

void read_fog(const nlohmann::json& document, Scene& scene);

/// Pose and lens, where the document has a camera.
void read_camera(const nlohmann::json& document, const ScenePlace& root, Scene& scene);

/// Keyframes start from the scene's camera.
void read_camera_paths(const nlohmann::json& document, const ScenePlace& root, Scene& scene);

/// As written: what they may be, the renderer knows.
void read_settings(const nlohmann::json& document, Scene& scene);

}  // namespace farlight
