// glTF texture references -> Texture: sampler, UV set, KHR_texture_transform.
#pragma once

#include "server/scene/gltf_image.h"

namespace farlight {

class GltfTextures {
public:
    explicit GltfTextures(const GltfContainer& gltf) : gltf_(gltf), images_(gltf) { }

    /// What the textureInfo owner[key] names; unused if there is none.
    Texture read(const nlohmann::json& owner, const char* key, const ScenePlace& place);

    std::vector<Image8> take_images() { return images_.take(); }
    std::vector<std::string> notes() const;

private:
    const GltfContainer& gltf_;
    GltfImages images_;
    std::size_t without_image_ = 0;  // textures that only an extension gives an image
    std::size_t other_uv_sets_ = 0;
    std::size_t smoothed_ = 0;  // that ask for a nearest texel where they shrink alone
};

}  // namespace farlight
