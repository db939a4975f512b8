// What a scene file says about the settings it is to be drawn with.
#pragma once

#include "server/render/settings.h"
#include "server/scene/scene_file.h"

#include <vector>

namespace farlight {

/// `base`, changed by what the scene says, changed by `set` (key=value, in order). Throws
/// SceneError that points at the setting; SettingError for one of `set`.
RenderSettings settings_for(
    const Scene& scene, const RenderSettings& base, const std::vector<std::string>& set);

/// Throws SceneError where the scene asks for settings that do not exist, that it cannot have, or
/// for fewer effects than the `effects` it calls for.
void check_settings(const Scene& scene, const std::vector<ActiveEffect>& effects);

}  // namespace farlight
