// Where a camera sees a point, in double precision: the oracle of motion vectors.
#pragma once

#include "server/render/camera.h"

namespace farlight {

/// Pixel coordinates, x to the right and y down, and view depth of a world position.
inline glm::dvec3 project(const CameraPose& pose, const glm::dvec3& position, const Extent& extent)
{
    const CameraBasis basis = camera_basis(pose);
    const double half_height = std::tan(glm::radians(pose.vertical_fov_degrees) / 2);
    const double half_width = half_height * extent.width / extent.height;
    const glm::dvec3 v = position - pose.position;
    const double depth = glm::dot(v, basis.forward);
    const double x = glm::dot(v, basis.right) / (depth * half_width);
    const double y = glm::dot(v, basis.up) / (depth * half_height);
    return {(x + 1) / 2 * extent.width, (1 - y) / 2 * extent.height, depth};
}

}  // namespace farlight
