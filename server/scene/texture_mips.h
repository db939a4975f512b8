// Images as textures hold them: numbers behind the texels, and levels of detail.
#pragma once

#include "server/scene/scene.h"

#include <vector>

namespace farlight {

/// How an image's 8-bit RGB is to be read; alpha is linear in both.
enum class TexelSpace : std::uint8_t {
    kSrgb,  ///< Colours: base colour, emission, specular tint.
    kLinear,  ///< Everything else: normals, roughness, weights.
};

/// The four channels as numbers in [0, 1], RGB in linear light.
glm::vec4 decoded(const glm::u8vec4& texel, TexelSpace space);

/// Level 0 is the image; each further one has half the width and height, rounded down, at least 1,
/// until one texel is left. Box filter in linear light, from the unrounded level above; odd sizes
/// weigh texels by how far the box covers them.
std::vector<Image8> mip_levels(const Image8& image, TexelSpace space);

/// Mean over all texels.
glm::vec4 mean_texel(const Image8& image, TexelSpace space);

}  // namespace farlight
