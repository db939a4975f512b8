// Documents, their edits, and the Scene of each.
#include "server/scene/scene_document.h"

#include "server/scene/json_text.h"
#include "server/scene/scene_error.h"
#include "server/scene/scene_json.h"

namespace farlight {

using Json = nlohmann::json;

namespace {

Json wrapped(const std::filesystem::path& gltf)
{
    return {{"version", 1}, {"objects", {{{"mesh", {{"file", gltf.filename().string()}}}}}}};
}

}  // namespace

SceneDocument::SceneDocument(Json document, const SceneDocument& before)
    : name_(before.name_)
    , is_gltf_(before.is_gltf_)
    , files_(before.files_)
    , document_(std::make_shared<const Json>(std::move(document)))
{
    scene_ = within_memory({name_, {}}, [&] {
        Scene scene = scene_from_json(*document_, {name_, is_gltf_}, *files_);
        if (scene.name.empty())
            scene.name = std::filesystem::path(name_).stem().string();
        return std::make_shared<const Scene>(std::move(scene));
    });
}

SceneDocument SceneDocument::load(const std::filesystem::path& file)
{
    SceneDocument place;
    place.name_ = file.string();
    place.is_gltf_ = farlight::is_gltf(file);
    place.files_ = std::make_shared<SceneFiles>(file.parent_path());
    if (place.is_gltf_) {
        if (!std::filesystem::exists(file))
            refuse({place.name_, {}}, "no such file", "a file");
        place.files_->gltf(file.filename().string(), {place.name_, {}});  // its errors are its own
        return {wrapped(file), place};
    }
    if (file.extension() != ".json" && !std::filesystem::is_directory(file)
        && std::filesystem::exists(file))
        refuse({file.string(), {}}, "the extension " + in_quotes(file.extension().string()),
            "a .json, .gltf or .glb file");
    return {parse_json(read_file(file), file.string()), place};
}

SceneDocument SceneDocument::edited(const Json& merge_patch) const
{
    Json patched = *document_;
    patched.merge_patch(merge_patch);
    files_->confine();
    return {std::move(patched), *this};
}

}  // namespace farlight
