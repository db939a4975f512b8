// Which texture array and layer each image of a scene lies in, and how a material refers to it.
//
// All images that are needed lie in at most TEXTURE_ARRAYS arrays, grouped by their size rounded up
// to powers of two and by how their texels are read. An array is as large as the largest of its
// images, so none takes more than four times its own memory unless there are too many groups. An
// image fills the lower corner of its layer as it is; each of its mip levels likewise.
#pragma once

#include "server/scene/texture_mips.h"
#include "shaders/shared/scene_layout.h"

#include <array>
#include <map>
#include <tuple>

namespace farlight {

/// What a device allows of one texture array; the defaults are what OpenGL 4.5 guarantees.
struct TextureLimits {
    std::uint32_t size = 16384;  ///< Largest width and height [texels].
    std::uint32_t layers = 2048;
};

/// An image as one of its uses reads it.
struct ImageUse {
    std::uint32_t image = kNone;
    TexelSpace space = TexelSpace::kLinear;

    bool operator<(const ImageUse& other) const
    {
        return std::tie(image, space) < std::tie(other.image, other.space);
    }
};

struct TextureArrayLayout {
    TexelSpace space = TexelSpace::kLinear;
    std::uint32_t width = 0;  ///< Of the widest image [texels].
    std::uint32_t height = 0;  ///< Of the highest.
    std::vector<std::uint32_t> images;  ///< One a layer.

    std::uint32_t levels() const;
    std::size_t bytes() const;  ///< Of all layers and levels.
};

/// Calls visit(texture, space) for every texture of a material, used or not.
template <typename Visit> void each_texture(const Material& m, const Visit& visit)
{
    for (const Texture* texture :
        {&m.albedo_texture, &m.emission_texture, &m.specular_color_texture})
        visit(*texture, TexelSpace::kSrgb);
    for (const Texture* texture : {&m.metallic_roughness_texture, &m.normal_texture,
             &m.specular_texture, &m.transmission_texture, &m.clearcoat_texture,
             &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture})
        visit(*texture, TexelSpace::kLinear);
}

using PackedTexture = std::array<glm::uvec4, TEXTURE_TEXELS>;

/// Used in three steps: need() for every texture that a material looks up, lay_out(), packed() for
/// each of them.
class TextureLayout {
public:
    /// `images` must outlive the layout.
    explicit TextureLayout(const std::vector<Image8>& images) : images_(images) { }

    /// A texture without image needs nothing.
    void need(const Texture& texture, TexelSpace space);
    /// Throws GlError naming limit and need when the images do not fit the device.
    void lay_out(const TextureLimits& limits);

    /// What the material's texels say of it; zeros, which shaders read as white, without image.
    PackedTexture packed(const Texture& texture, TexelSpace space) const;
    const std::vector<TextureArrayLayout>& arrays() const { return arrays_; }
    const std::vector<Image8>& images() const { return images_; }

private:
    const std::vector<Image8>& images_;
    std::map<ImageUse, std::uint32_t> places_;  ///< array << 16 | layer.
    std::vector<TextureArrayLayout> arrays_;
};

}  // namespace farlight
