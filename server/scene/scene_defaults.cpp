// Framing and default light.
#include "server/scene/scene_defaults.h"

#include "server/scene/camera_limits.h"

#include <algorithm>
#include <cmath>

namespace farlight {
namespace {

/// The lamp is seen under (r / d)^2 = 1/25: white that faces it shines with 0.2 + 16 / 25 = 0.84,
/// not quite white on a display, and what it does not reach with up to 0.2.
constexpr float kSkyRadiance = 0.2F;
constexpr float kLampRadiance = 16;

/// Or shows without light.
bool is_lit(const Scene& scene)
{
    if (scene.background != glm::vec3(0) || scene.environment || !scene.lights.empty())
        return true;
    const auto material = [&](const Object& object) -> const Material& {
        return scene.materials[object.material];
    };
    const auto& objects = scene.objects;
    return std::any_of(objects.begin(), objects.end(), [&](const Object& o) {
        // What glows in a picture is a label or a display, and lights nothing else.
        return material(o).emission != glm::vec3(0) && !material(o).emission_texture.used();
    }) || std::all_of(objects.begin(), objects.end(), [&](const Object& o) {
        return material(o).unlit;
    });
}

}  // namespace

CameraPose framing_camera(const Bounds& bounds)
{
    CameraPose camera;
    camera.vertical_fov_degrees = 45;
    const double half_angle = 0.5 * glm::radians(camera.vertical_fov_degrees);
    const double fits = bounds.radius() / std::sin(half_angle);  // the sphere, and no more
    const double distance =
        usable_distance(std::max(fits, 2 * nearest_target(bounds.center(), bounds.center())));
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
    if (is_lit(scene))
        return;
    // Light from all around alone would make a white model vanish before a white background: a lamp
    // models it.
    const Bounds bounds = scene_bounds(scene);
    const glm::dvec3 direction =
        glm::normalize(glm::dvec3(-0.5, 1, 0.6));  // over the viewer's left shoulder
    const double distance = 5 * bounds.radius();
    scene.background = glm::vec3(kSkyRadiance);
    scene.materials.push_back({"default light", glm::vec3(0), glm::vec3(kLampRadiance)});
    scene.objects.push_back(
        {"default light", static_cast<std::uint32_t>(scene.materials.size() - 1),
            Sphere{bounds.center() + distance * direction, bounds.radius()}, false});
    scene.notes.push_back("the file has no light: a soft one comes from all around, and one from a "
                          "lamp over the viewer's left shoulder");
}

}  // namespace farlight
