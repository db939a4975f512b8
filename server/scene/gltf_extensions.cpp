// The list; each name is read where it is written in a gltf_*.cpp.
#include "server/scene/gltf_extensions.h"

#include <algorithm>
#include <array>

namespace farlight {

namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 12> kRead{
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};

bool is_read(const std::string& extension)
{
    return std::find(kRead.begin(), kRead.end(), extension) != kRead.end();
}

std::string joined(const auto& names)
{
    std::string list;
    for (const auto& name : names)
        list.append(list.empty() ? "" : ", ").append(name);
    return list;
}

std::vector<std::string> unread(const Json& names)
{
    std::vector<std::string> found;
    for (const Json& name : names)
        if (!is_read(name.get<std::string>()))
            found.push_back(name.get<std::string>());
    return found;
}

}  // namespace

void check_gltf_extensions(const Json& document, const ScenePlace& root)
{
    const std::vector<std::string> lacking =
        unread(document.value("extensionsRequired", Json::array()));
    if (!lacking.empty())
        refuse(root / "extensionsRequired", joined(lacking),
            "none but extensions that Farlight reads: " + joined(kRead));
}

std::vector<std::string> unread_gltf_extensions(const Json& document)
{
    return unread(document.value("extensionsUsed", Json::array()));
}

}  // namespace farlight
