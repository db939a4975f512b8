// Reads the parts of a document that fits the schema in the order in which they need each other;
// what a schema cannot say is checked by each part.
#include "server/scene/scene_json.h"

#include "server/scene/json_schema.h"
#include "server/scene/material_textures.h"
#include "server/scene/scene_defaults.h"
#include "server/scene/scene_json_light.h"
#include "server/scene/scene_json_object.h"
#include "server/scene/scene_json_surroundings.h"

#include <algorithm>
#include <cmath>

namespace farlight {

namespace {

using Json = nlohmann::json;

/// A place far out times a scale can leave what a float holds though each number was fine.
bool lacks_uvs(const Scene& scene, const Object& object)
{
    const auto* instance = std::get_if<MeshInstance>(&object.shape);
    if (instance == nullptr)
        return false;
    const Mesh& mesh = scene.meshes[instance->mesh];
    const auto textures = textures_of(scene.materials[object.material]);
    return std::any_of(textures.begin(), textures.end(), [&](const Texture* texture) {
        return texture->used() && mesh.uvs[texture->uv_set].empty();
    });
}

void note_missing_uvs(Scene& scene)
{
    const auto count = std::count_if(scene.objects.begin(), scene.objects.end(),
        [&](const Object& object) { return lacks_uvs(scene, object); });
    if (count > 0)
        scene.notes.push_back(std::to_string(count)
            + " objects with a textured material lack texture coordinates: they show the texel at "
              "0, 0");
}

}  // namespace

void check_extent(const Scene& scene)
{
    const Bounds bounds = scene_bounds(scene);
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(bounds.lower[axis]) <= kLargestCoordinate
                && std::abs(bounds.upper[axis]) <= kLargestCoordinate))
            refuse({scene.file, {}}, "objects beyond 1e11 in world space",
                "coordinates of at most 1e11 in magnitude");
}

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
    note_missing_uvs(scene);
    read_camera_paths(document, root, scene);
    if (source.is_gltf)
        add_default_light(scene);
    return scene;
}

}  // namespace farlight
