// Camera: a pose in double precision -> the constants that shaders see.
#pragma once

#include "server/gl/extent.h"
#include "server/scene/scene.h"
#include "shaders/shared/frame_constants.h"

namespace farlight {

/// Orthonormal frame of a pose. An `up` along the view is replaced by the axis least aligned with
/// it.
struct CameraBasis {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 forward;
};

CameraBasis camera_basis(const CameraPose& pose);

/// `origin`: from where positions on the device are counted (Scene::origin).
shared::CameraConstants camera_constants(
    const CameraPose& pose, Extent extent, const glm::dvec3& origin = glm::dvec3(0));

}  // namespace farlight
