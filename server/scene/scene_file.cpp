// Chooses the reader by extension.
#include "server/scene/scene_file.h"

#include "server/scene/gltf_file.h"
#include "server/scene/json_text.h"
#include "server/scene/mesh_repair.h"
#include "server/scene/scene_defaults.h"
#include "server/scene/scene_error.h"
#include "server/scene/scene_json.h"

#include <cmath>

namespace farlight {

namespace {

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

Scene load_scene(const std::filesystem::path& file)
{
    if (is_gltf(file)) {
        GltfScene gltf = load_gltf(file);
        if (!gltf.has_camera)
            add_framing_camera(gltf.scene);
        check_extent(gltf.scene);
        add_default_light(gltf.scene);
        return std::move(gltf.scene);
    }
    if (file.extension() != ".json" && !std::filesystem::is_directory(file)
        && std::filesystem::exists(file))
        refuse({file.string(), {}}, "the extension " + in_quotes(file.extension().string()),
            "a .json, .gltf or .glb file");
    Scene scene = parse_scene(read_file(file), file.parent_path(), file.string());
    if (scene.name.empty())
        scene.name = file.stem().string();
    return scene;
}

Scene parse_scene(
    std::string_view json_text, const std::filesystem::path& base_dir, const std::string& name)
{
    if (json_text.empty())
        refuse({name, {}}, "an empty text", "a scene");
    Scene scene = scene_from_json(parse_json(json_text, name), base_dir, name);
    check_extent(scene);
    return scene;
}

}  // namespace farlight
