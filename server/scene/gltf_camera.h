// glTF cameras -> the scene's camera and its camera paths.
#pragma once

#include "server/scene/gltf_rig.h"

namespace farlight {

/// The first camera of the tree, perspective ones before others, gives `scene` its own; the others,
/// and all that an animation moves, become paths named after the camera. Whether there was one. The
/// scene has its objects and what moves them. Throws SceneError.
bool read_gltf_cameras(
    const GltfContainer& gltf, const GltfTree& tree, const GltfRig& rig, Scene& scene);

}  // namespace farlight
