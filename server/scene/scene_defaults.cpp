// Framing and default light.
#include "server/scene/scene_defaults.h"

#include <algorithm>
#include <cmath>

namespace farlight {

CameraPose framing_camera(const Bounds& bounds)
{
    CameraPose camera;
    camera.vertical_fov_degrees = 45;
    const double half_angle = 0.5 * glm::radians(camera.vertical_fov_degrees);
    const double distance = bounds.radius() / std::sin(half_angle);  // the sphere just fits
    // Three-quarter view: 32 degrees to the right of +z, 17 degrees up.
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.6, 0.35, 0.95));
    camera.target = bounds.center();
    camera.position = bounds.center() + distance * direction;
    return camera;
}

void add_framing_camera(Scene& scene)
{
    scene.camera = framing_camera(scene_bounds(scene));
    scene.notes.emplace_back("the file has no camera: one was placed that sees everything");
}

void add_default_light(Scene& scene)
{
    const bool object_emits =
        std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
            return scene.materials[object.material].emission != glm::vec3(0);
        });
    if (object_emits || scene.background != glm::vec3(0))
        return;
    scene.background = glm::vec3(1);
    scene.notes.emplace_back("the file has no light: a soft one comes from all around, radiance 1");
}

}  // namespace farlight
