// glTF cameras -> camera poses.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/scene.h"

#include <optional>

namespace farlight {

/// The pose of the camera `json`, a perspective one, standing at `world_from_node` before objects
/// within `bounds`. Nothing if the transform leaves it no direction. A field of view beyond the
/// limits of camera_limits.h is clamped and noted.
std::optional<CameraPose> gltf_camera_pose(const nlohmann::json& json,
    const glm::dmat4& world_from_node, const Bounds& bounds, std::vector<std::string>& notes);

}  // namespace farlight
