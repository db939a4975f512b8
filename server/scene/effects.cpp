// One row an effect. Reasons name the first object that calls for it.
#include "server/scene/effects.h"

#include <algorithm>
#include <functional>

namespace farlight {
namespace {

bool emits(const Scene& scene, const Object& object)
{
    const glm::vec3& emission = scene.materials[object.material].emission;
    return emission.x > 0 || emission.y > 0 || emission.z > 0;
}

/// "N THINGS, first 'name'", where the first object that `wanted` accepts gives the name; nothing
/// for none.
std::optional<std::string> counted(const Scene& scene, std::size_t count, const char* things,
    const std::function<bool(const Object&)>& wanted)
{
    if (count == 0)
        return std::nullopt;
    const auto first = std::find_if(scene.objects.begin(), scene.objects.end(), wanted);
    return std::to_string(count) + " " + things
        + (first == scene.objects.end() ? "" : ", first '" + first->name + "'");
}

bool is_sphere(const Object& object)
{
    return std::holds_alternative<Sphere>(object.shape);
}

std::optional<std::string> triangles(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content.triangles, "triangles",
        [](const Object& object) { return !is_sphere(object); });
}

std::optional<std::string> spheres(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content.spheres, "spheres", is_sphere);
}

std::optional<std::string> shading_normals(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content.smooth_triangles, "smooth triangles", [&](const Object& object) {
        const auto* instance = std::get_if<MeshInstance>(&object.shape);
        return instance != nullptr && !scene.meshes[instance->mesh].normals.empty();
    });
}

std::optional<std::string> area_lights(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content.polygon_lights + content.sphere_lights, "emitters",
        [&](const Object& object) { return emits(scene, object); });
}

std::optional<std::string> polygon_lights(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content.polygon_lights, "emissive triangles and quads",
        [&](const Object& object) { return !is_sphere(object) && emits(scene, object); });
}

std::optional<std::string> sphere_lights(const Scene& scene, const SceneContent& content)
{
    return counted(scene, content.sphere_lights, "emissive spheres",
        [&](const Object& object) { return is_sphere(object) && emits(scene, object); });
}

std::optional<std::string> background(const Scene& scene, const SceneContent& /*content*/)
{
    const glm::vec3& radiance = scene.background;
    if (radiance == glm::vec3(0))
        return std::nullopt;
    return "background radiance " + std::to_string(radiance.x) + " " + std::to_string(radiance.y)
        + " " + std::to_string(radiance.z);
}

}  // namespace

const std::vector<Effect>& effect_registry()
{
    static const std::vector<Effect> effects{
        {"triangles", "FX_TRIANGLES", triangles},
        {"spheres", "FX_SPHERES", spheres},
        {"shading normals", "FX_SHADING_NORMALS", shading_normals},
        {"area lights", "FX_LIGHTS", area_lights},
        {"polygon lights", "FX_POLYGON_LIGHTS", polygon_lights},
        {"sphere lights", "FX_SPHERE_LIGHTS", sphere_lights},
        {"background", "FX_BACKGROUND", background},
    };
    return effects;
}

std::vector<ActiveEffect> active_effects(const Scene& scene, const SceneContent& content)
{
    std::vector<ActiveEffect> active;
    for (const Effect& effect : effect_registry())
        if (auto reason = effect.reason(scene, content))
            active.push_back({effect.name, effect.macro, *std::move(reason)});
    return active;
}

}  // namespace farlight
