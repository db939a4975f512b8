// Keeps from tinygltf what it does not check well itself: extras, unknown extensions, images.
#include "server/scene/gltf_model.h"

#include "server/scene/scene_error.h"

#include <array>
#include <charconv>
#include <tiny_gltf.h>

namespace farlight {

namespace {

using Json = nlohmann::json;
using Buffers = std::vector<std::vector<unsigned char>>;

// Stands for the i-th of GltfContainer::buffers where tinygltf expects a file's name.
constexpr std::string_view kBufferName = "buffer-";

void drop_extras(Json& value)
{
    if (value.is_object()) {
        value.erase("extras");
        if (const auto extensions = value.find("extensions"); extensions != value.end()) {
            Json kept = Json::object();
            if (extensions->contains("KHR_materials_emissive_strength"))
                kept["KHR_materials_emissive_strength"] =
                    extensions->at("KHR_materials_emissive_strength");
            *extensions = kept;
        }
    }
    for (Json& child : value)
        if (child.is_structured())
            drop_extras(child);
}

/// Textures go too: what they would look like is not read.
void drop_textures(Json& material)
{
    for (const char* const key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        material.erase(key);
    if (material.contains("pbrMetallicRoughness"))
        for (const char* const key : {"baseColorTexture", "metallicRoughnessTexture"})
            material["pbrMetallicRoughness"].erase(key);
}

Json reduced(const Json& document)
{
    constexpr std::array<const char*, 10> kKept{"asset", "scene", "scenes", "nodes", "meshes",
        "accessors", "bufferViews", "buffers", "materials", "cameras"};
    Json kept;
    for (const char* const key : kKept)
        if (document.contains(key))
            kept[key] = document[key];
    drop_extras(kept);
    if (kept.contains("materials"))
        for (Json& material : kept["materials"])
            drop_textures(material);
    if (kept.contains("buffers"))
        for (std::size_t i = 0; i < kept["buffers"].size(); ++i)
            if (!is_data_uri(kept["buffers"][i].value("uri", "")))
                kept["buffers"][i]["uri"] = std::string(kBufferName) + std::to_string(i);
    return kept;
}

tinygltf::FsCallbacks serve(const Buffers& buffers)
{
    tinygltf::FsCallbacks callbacks{};
    callbacks.FileExists = [](const std::string& name, void*) {
        return name.starts_with(kBufferName);
    };
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* /*error*/,
                                  const std::string& name, void* user) {
        std::size_t index = 0;
        const char* const end = name.data() + name.size();
        const auto [stop, error] = std::from_chars(name.data() + kBufferName.size(), end, index);
        const auto& served = *static_cast<const Buffers*>(user);
        if (error != std::errc() || stop != end || index >= served.size())
            return false;
        *out = served[index];
        return true;
    };
    callbacks.WriteWholeFile = [](std::string*, const std::string&,
                                   const std::vector<unsigned char>&, void*) { return false; };
    callbacks.user_data = const_cast<Buffers*>(&buffers);  // only ever read
    return callbacks;
}

}  // namespace

tinygltf::Model to_tinygltf(const GltfContainer& container, const std::string& file)
{
    const Json document = reduced(container.document);
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(serve(container.buffers));
    loader.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int,
                              const unsigned char*, int, void*) { return true; },
        nullptr);

    tinygltf::Model model;
    std::string error;
    std::string warning;
    const std::string text = document.dump();
    if (!loader.LoadASCIIFromString(
            &model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()), ""))
        refuse(
            {file, {}}, "a glTF file that cannot be read: " + in_quotes(error), "valid glTF 2.0");
    for (std::size_t i = 0; i < model.buffers.size(); ++i) {
        const std::size_t length = document["buffers"][i]["byteLength"].get<std::size_t>();
        if (model.buffers[i].data.size() < length)
            refuse(ScenePlace{file, {}} / "buffers" / i / "uri",
                "a data URI of " + std::to_string(model.buffers[i].data.size()) + " bytes",
                "at least " + std::to_string(length));
    }
    return model;
}

}  // namespace farlight
