// /lights of a Farlight scene document.
#pragma once

#include "server/scene/scene_json_motion.h"

namespace farlight {

void read_lights(
    const nlohmann::json& document, const ScenePlace& root, SceneMotion& motion, Scene& scene);

}  // namespace farlight
