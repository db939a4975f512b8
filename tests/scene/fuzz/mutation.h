// Changes to scene files that keep their outer form: most bytes at random would only break it.
#pragma once

#include "tests/scene/fuzz/scene_input.h"

#include <functional>
#include <random>

namespace farlight {

/// The two parts of a scene file that mutations work on; a .json or .gltf has no binary.
struct SceneParts {
    std::string json;
    std::string binary;
};

/// Bytes that are no GLB are all JSON.
SceneParts split_scene(SceneFormat format, std::string_view bytes);
std::string join_scene(SceneFormat format, const SceneParts& parts);

/// One to four values of the document replaced, removed or copied elsewhere; bytes of the binary
/// changed. Text that is no JSON has its bytes changed instead.
void mutate_scene(SceneParts& parts, std::mt19937& random);

}  // namespace farlight
