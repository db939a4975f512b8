// Poses in double precision to ray frames in single.
#include "server/render/camera.h"

#include "server/host_guard.h"

#include <cmath>

namespace farlight {
namespace {

const HostGuard up_along_the_view("up_along_the_view");
const HostGuard up_is_upright("up_is_upright");

/// The unit vector along v, or `fallback` when v has no direction.
glm::dvec3 direction_or(const glm::dvec3& v, const glm::dvec3& fallback)
{
    const double length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : fallback;
}

glm::dvec3 least_aligned_axis(const glm::dvec3& v)
{
    const glm::dvec3 a = glm::abs(v);
    return a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
        : a.y <= a.z                ? glm::dvec3(0, 1, 0)
                                    : glm::dvec3(0, 0, 1);
}

}  // namespace

CameraBasis camera_basis(const CameraPose& pose)
{
    CameraBasis basis;
    basis.forward = direction_or(pose.target - pose.position, {0, 0, -1});
    const glm::dvec3 up = direction_or(pose.up, {0, 1, 0});
    glm::dvec3 right = glm::cross(basis.forward, up);
    if (up_along_the_view
        && glm::length(right)
            < 1e-6)  // sine of the angle: closer than this, rounding would choose the roll
        right = glm::cross(basis.forward, least_aligned_axis(basis.forward));
    basis.right = glm::normalize(right);
    basis.up = up_is_upright ? glm::cross(basis.right, basis.forward) : up;
    return basis;
}

shared::CameraConstants camera_constants(
    const CameraPose& pose, Extent extent, const glm::dvec3& origin)
{
    const CameraBasis basis = camera_basis(pose);
    const double half_height = std::tan(glm::radians(pose.vertical_fov_degrees) / 2);
    const double half_width = half_height * extent.width / extent.height;
    shared::CameraConstants constants{};
    constants.position = glm::vec3(pose.position - origin);
    constants.pixel_footprint = static_cast<float>(2 * half_height / extent.height);
    constants.forward = glm::vec3(basis.forward);
    constants.width = static_cast<float>(extent.width);
    constants.height = static_cast<float>(extent.height);
    constants.right = glm::vec3(half_width * basis.right);
    constants.up = glm::vec3(half_height * basis.up);
    return constants;
}

}  // namespace farlight
