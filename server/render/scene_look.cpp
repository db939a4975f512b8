// What of a scene shows at a glance.
#include "server/render/scene_look.h"

#include "server/host_guard.h"
#include "server/scene/material_response.h"

#include <algorithm>

namespace farlight {
namespace {

const HostGuard radius_of_nothing("radius_of_nothing");

bool any_light(const Scene& scene)
{
    const auto drawn = [&](auto&& wanted) {
        return std::any_of(scene.objects.begin(), scene.objects.end(),
            [&](const Object& object) { return wanted(scene.materials[object.material]); });
    };
    return !is_black(scene.background)
        || drawn([](const Material& m) { return m.unlit || !is_black(m.emission); })
        || std::any_of(scene.lights.begin(), scene.lights.end(),
            [](const PunctualLight& light) { return !is_black(light.intensity); });
}

bool any_scatterer(const Scene& scene)
{
    return !is_black(scene.medium.sigma_s)
        || std::any_of(scene.objects.begin(), scene.objects.end(),
            [&](const Object& object) { return scatters(scene.materials[object.material]); });
}

bool any_holes(const Scene& scene)
{
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return scene.materials[object.material].alpha_mode != AlphaMode::kOpaque;
    });
}

// Fog ends somewhere, or no light from outside would ever arrive; four radii of the scene hold
// whatever a camera that frames it sees of it, and the camera.
constexpr double kFogRadii = 4;

}  // namespace

SceneLook look_of(const Scene& scene)
{
    SceneLook look;
    const Bounds bounds = scene_bounds(scene);
    const double radius = bounds.empty() && radius_of_nothing ? 1 : bounds.radius();
    look.background = scene.background;
    look.radius = static_cast<float>(radius);
    look.lens = scene.lens;
    look.origin = scene.origin;
    look.fog.sigma_t = scene.medium.sigma_a + scene.medium.sigma_s;
    look.fog.sigma_s = scene.medium.sigma_s;
    look.fog.g = scene.medium.g;
    look.fog.center = bounds.empty() ? glm::vec3(0) : glm::vec3(bounds.center());
    look.fog.radius = static_cast<float>(kFogRadii * radius);
    look.holes = any_holes(scene);
    look.scatters = any_light(scene) && any_scatterer(scene);
    return look;
}

}  // namespace farlight
