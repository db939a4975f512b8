// A Farlight scene document, version 1 -> Scene.
#pragma once

#include "server/scene/scene.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace farlight {

/// `document` is any JSON; it is checked against the schema first. Throws SceneError.
Scene scene_from_json(
    const nlohmann::json& document, const std::filesystem::path& base_dir, const std::string& name);

}  // namespace farlight
