// A glTF camera looks along its -z; it has no target, so the point nearest to the scene's middle
// stands for it.
#include "server/scene/gltf_camera.h"

#include "server/scene/camera_limits.h"

#include <algorithm>

namespace farlight {

std::optional<CameraPose> gltf_camera_pose(const nlohmann::json& json,
    const glm::dmat4& world_from_node, const Bounds& bounds, std::vector<std::string>& notes)
{
    const glm::dvec3 position(world_from_node[3]);
    const glm::dvec3 view = glm::normalize(-glm::dvec3(world_from_node[2]));
    const glm::dvec3 up = glm::normalize(glm::dvec3(world_from_node[1]));
    if (!(glm::length(view) > 0) || !(glm::length(up) > 0))
        return std::nullopt;
    const double ahead = glm::dot(bounds.center() - position, view);
    const double nearest = 2 * nearest_target(position, position);
    const double distance =
        usable_distance(ahead > nearest ? ahead : std::max(bounds.radius(), glm::length(position)));
    const double wanted_fov = glm::degrees(json["perspective"]["yfov"].get<double>());
    const double fov = std::clamp(wanted_fov, kNarrowestFov, kWidestFov);
    if (fov != wanted_fov)
        notes.push_back("the camera's yfov of " + nlohmann::json(wanted_fov).dump()
            + " degrees is drawn as " + nlohmann::json(fov).dump());
    return CameraPose{.position = position,
        .target = position + distance * view,
        .up = up,
        .vertical_fov_degrees = fov};
}

}  // namespace farlight
