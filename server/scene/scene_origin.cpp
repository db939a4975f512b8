// One point for a scene, subtracted once.
#include "server/scene/scene_origin.h"

#include "server/host_guard.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace farlight {
namespace {

const HostGuard counts_from_near("counts_from_near");
const HostGuard follows_the_camera("follows_the_camera");

/// Within so many times the size of what is looked at, single precision tells 2^-18 of it apart,
/// which is less than a pixel of any picture.
constexpr double kNear = 32;

/// From so many of its radii on, a thing that fills a picture of some hundred lines is off by one.
constexpr double kWide = 65536;

double largest(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

void move(Sphere& sphere, const glm::dvec3& by)
{
    sphere.center += by;
}
void move(Disk& disk, const glm::dvec3& by)
{
    disk.center += by;
}
void move(Quad& quad, const glm::dvec3& by)
{
    quad.corner += by;
}
void move(MeshInstance& instance, const glm::dvec3& by)
{
    instance.world_from_object[3] += glm::dvec4(by, 0);
}

}  // namespace

glm::dvec3 origin_of(const Scene& scene)
{
    const Bounds bounds = scene_bounds(scene);
    if (!counts_from_near || bounds.empty() || !std::isfinite(bounds.radius()))
        return glm::dvec3(0);
    const double distance = glm::length(scene.camera.target - scene.camera.position);
    // A scene of one point has no radius, a camera may have no target.
    const double size =
        bounds.radius() > 0 && distance > 0 ? std::min(bounds.radius(), distance) : distance;
    const glm::dvec3 looked_at = glm::clamp(scene.camera.target, bounds.lower, bounds.upper);
    if (!(size > 0) || !(largest(looked_at) > kNear * size))
        return glm::dvec3(0);
    const double step = std::ldexp(8.0, std::ilogb(size) + 1);
    return glm::round(looked_at / step) * step;
}

bool is_wide(const Scene& scene)
{
    const std::vector<Bounds> objects = object_bounds(scene);
    bool lost = false;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Bounds& b = objects[i];
        const double reach = std::max(largest(b.lower), largest(b.upper));
        lost = lost
            || (scene.objects[i].framed && !b.empty() && std::isfinite(reach) && b.radius() > 0
                && reach > kWide * b.radius());
    }
    return follows_the_camera && lost;
}

glm::dvec3 origin_near(const glm::dvec3& camera, double scene_radius)
{
    const double step = std::ldexp(1.0, std::ilogb(scene_radius) - 9);
    return glm::round(camera / step) * step;
}

void count_from(Scene& scene, const glm::dvec3& origin)
{
    if (origin == glm::dvec3(0))
        return;
    for (Object& object : scene.objects)
        if (object.node == kNone)
            std::visit([&](auto& shape) { move(shape, -origin); }, object.shape);
    for (PunctualLight& light : scene.lights)
        if (light.node == kNone)
            light.position -= origin;
    for (Node& node : scene.animation.nodes)
        if (node.parent == kNone)
            node.local = glm::translate(glm::dmat4(1), -origin) * node.local;
    scene.origin += origin;
}

}  // namespace farlight
