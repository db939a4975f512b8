// Textured lights: where on its textures a light lies, and what they leave of its radiance.
#pragma once

#include "server/scene/lights.h"
#include "server/scene/texels.h"
#include "server/scene/textures.h"

#include <functional>
#include <map>

namespace farlight {

class LightTextures {
public:
    /// Both must outlive this.
    LightTextures(const Scene& scene, const TextureLayout& layout) : scene_(scene), layout_(layout)
    {
    }

    /// Fills in what material and textures say of the light's strength: radiance, mean luminance,
    /// sides. Returns its place in texels() + 1, or 0 for a light without textures.
    std::uint32_t add(Light& light);
    /// Layout: `light_textures` in shaders/shared/scene_layout.h.
    const Texels& texels() const { return texels_; }

private:
    const std::vector<Image8>& levels_of(std::uint32_t image);
    enum class Detail { kFinest, kAveraged };
    using Shown = std::function<glm::dvec4(const glm::dvec4&)>;
    /// Of what is `shown` of the texels over a triangle, or a parallelogram, of texture
    /// coordinates.
    glm::dvec4 mean(const Texture& texture, const std::array<glm::vec2, 3>& uv, bool triangle,
        Detail detail, const Shown& shown);

    const Scene& scene_;
    const TextureLayout& layout_;
    Texels texels_;
    std::map<std::uint32_t, std::vector<Image8>> levels_;  ///< Of each image that lights show.
};

}  // namespace farlight
