// The one meaning of an offset, a rotation and a scale of texture coordinates.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace farlight {

/// Texture::image_from_uv. The rotation [rad] is counter-clockwise as seen on the picture, whose v
/// points down; scale first, then rotation, then offset.
/// Source: Khronos Group, glTF extension KHR_texture_transform.
inline glm::mat3 texture_transform(const glm::vec2& offset, float rotation, const glm::vec2& scale)
{
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    return {{scale.x * c, -scale.x * s, 0}, {scale.y * s, scale.y * c, 0}, {offset, 1}};
}

}  // namespace farlight
