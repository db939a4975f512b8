// Every scene is read through its document.
#include "server/scene/scene_file.h"

#include "server/scene/json_text.h"
#include "server/scene/scene_document.h"
#include "server/scene/scene_error.h"
#include "server/scene/scene_json.h"

namespace farlight {

Scene load_scene(const std::filesystem::path& file)
{
    return SceneDocument::load(file).scene();
}

Scene parse_scene(
    std::string_view json_text, const std::filesystem::path& base_dir, const std::string& name)
{
    if (json_text.empty())
        refuse({name, {}}, "an empty text", "a scene");
    SceneFiles files(base_dir);
    return scene_from_json(parse_json(json_text, name), {name}, files);
}

}  // namespace farlight
