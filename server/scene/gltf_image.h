// glTF images -> Image8, each source decoded once.
#pragma once

#include "server/scene/gltf_container.h"
#include "server/scene/scene.h"

#include <map>
#include <unordered_map>

namespace farlight {

class GltfImages {
public:
    explicit GltfImages(const GltfContainer& gltf) : gltf_(gltf) { }

    /// Index into images() for the glTF image `index`, found at `place`. Throws SceneError for an
    /// image that is missing or cannot be decoded.
    std::uint32_t read(const nlohmann::json& index, const ScenePlace& place);

    std::vector<Image8> take() { return std::move(images_); }

private:
    std::string_view encoded(const nlohmann::json& image, const ScenePlace& place);

    const GltfContainer& gltf_;
    std::deque<std::string> files_;  // bytes of uris
    std::map<std::size_t, std::uint32_t> by_index_;
    std::unordered_map<std::string_view, std::uint32_t> by_bytes_;  // two may hold the same picture
    std::vector<Image8> images_;
};

}  // namespace farlight
