// Documents, their edits, and the Scene of each.
#include "server/scene/scene_document.h"

#include "server/scene/gltf_file.h"
#include "server/scene/json_text.h"
#include "server/scene/scene_error.h"

namespace farlight {

using Json = nlohmann::json;

SceneDocument SceneDocument::load(const std::filesystem::path& file)
{
    SceneDocument loaded;
    loaded.scene_ = std::make_shared<const Scene>(load_scene(file));
    if (is_gltf(file))
        loaded.document_ = std::make_shared<const Json>(
            Json{{"version", 1}, {"objects", {{{"mesh", {{"file", file.filename().string()}}}}}}});
    else
        loaded.document_ = std::make_shared<const Json>(parse_json(read_file(file), file.string()));
    return loaded;
}

SceneDocument SceneDocument::edited(const Json& merge_patch) const
{
    Json patched = *document_;
    patched.merge_patch(merge_patch);
    SceneDocument edited;
    edited.scene_ = std::make_shared<const Scene>(parse_scene(
        patched.dump(), std::filesystem::path(scene_->file).parent_path(), scene_->file));
    edited.document_ = std::make_shared<const Json>(std::move(patched));
    return edited;
}

}  // namespace farlight
