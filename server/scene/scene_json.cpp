// Reads the parts of a document that fits the schema in the order in which they need each other;
// what a schema cannot say is checked by each part.
#include "server/scene/scene_json.h"

#include "server/scene/json_schema.h"
#include "server/scene/scene_defaults.h"
#include "server/scene/scene_json_light.h"
#include "server/scene/scene_json_object.h"
#include "server/scene/scene_json_surroundings.h"

#include <cmath>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// A place far out times a scale can leave what a float holds though each number was fine.
void check_extent(const Scene& scene)
{
    const Bounds bounds = scene_bounds(scene);
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(bounds.lower[axis]) <= kLargestCoordinate
                && std::abs(bounds.upper[axis]) <= kLargestCoordinate))
            refuse({scene.file, {}}, "objects beyond 1e11 in world space",
                "coordinates of at most 1e11 in magnitude");
}

}  // namespace

Scene scene_from_json(const Json& document, const SceneSource& source, SceneFiles& files)
{
    check_schema(document, farlight_scene_schema(), source.name);
    const ScenePlace root{source.name, {}};
    Scene scene;
    scene.file = source.name;
    read_environment(document, root, files, scene);
    read_fog(document, scene);
    read_settings(document, scene);
    SceneMaterials materials(scene, files);
    if (document.contains("materials"))
        materials.read(document["materials"], root / "materials");
    SceneMotion motion(document, scene);
    GltfInstances instances(scene, files, source.is_gltf);
    SceneObjects objects(scene, materials, motion, instances);
    if (document.contains("meshes"))
        objects.read_meshes(document["meshes"], root / "meshes");
    objects.read(document["objects"], root / "objects");
    read_lights(document, root, motion, scene);
    read_timeline(document, root, motion, materials, scene);
    for (std::string& note : objects.repairs().notes())
        scene.notes.push_back(std::move(note));
    scene.name = document.value("name", scene.name);
    if (!document.contains("camera") && !instances.has_camera())
        add_framing_camera(scene);
    read_camera(document, root, scene);
    check_extent(scene);
    read_camera_paths(document, root, scene);
    if (source.is_gltf)
        add_default_light(scene);
    return scene;
}

}  // namespace farlight
