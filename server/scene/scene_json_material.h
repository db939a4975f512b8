// /materials of a Farlight scene document.
#pragma once

#include "server/scene/scene_files.h"

#include <nlohmann/json_fwd.hpp>

namespace farlight {

/// Material names -> materials of the scene; pictures are shared by file.
class SceneMaterials {
public:
    SceneMaterials(Scene& scene, SceneFiles& files) : scene_(scene), files_(files) { }

    void read(const nlohmann::json& materials, const ScenePlace& place);

    /// The material called `name`. Refuses one that is not there.
    std::uint32_t at(const std::string& name, const ScenePlace& place) const;

private:
    Material read_material(const nlohmann::json& value, const ScenePlace& place);
    Texture read_texture(const nlohmann::json& value, const ScenePlace& place);

    Scene& scene_;
    SceneFiles& files_;
    std::map<std::string, std::uint32_t> by_name_;
    std::map<std::string, std::uint32_t> image_by_file_;
};

}  // namespace farlight
