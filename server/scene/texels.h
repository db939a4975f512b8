// 16-byte texels of the scene's buffers (shaders/shared/scene_layout.h): bits of floats, packed
// directions.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include <vector>

namespace farlight {

using Texels = std::vector<glm::uvec4>;

inline std::uint32_t bits(float value)
{
    return glm::floatBitsToUint(value);
}

inline glm::uvec4 texel(const glm::vec3& xyz, std::uint32_t w)
{
    return {glm::floatBitsToUint(xyz), w};
}

/// Octahedral unit vector in two 16-bit signed normalised numbers; zero vectors become +z.
/// Source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
/// Vectors".
inline std::uint32_t pack_octahedral(const glm::vec3& n)
{
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0))
        return glm::packSnorm2x16({0, 0});
    glm::vec2 p = glm::vec2(n) / sum;
    if (n.z < 0)
        p = (1.0F - glm::abs(glm::vec2(p.y, p.x)))
            * glm::vec2(p.x >= 0 ? 1 : -1, p.y >= 0 ? 1 : -1);
    return glm::packSnorm2x16(p);
}

}  // namespace farlight
