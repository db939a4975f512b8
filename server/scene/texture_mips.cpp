// Decoding, box filtering, encoding. Source of the curve: IEC 61966-2-1 (sRGB).
#include "server/scene/texture_mips.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace farlight {
namespace {

double srgb_decoded(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Linear values of the 256 codes.
std::array<float, 256> decoding_table(TexelSpace space)
{
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double encoded = static_cast<double>(i) / 255;
        table[i] = static_cast<float>(space == TexelSpace::kSrgb ? srgb_decoded(encoded) : encoded);
    }
    return table;
}

const std::array<float, 256>& codes(TexelSpace space)
{
    static const std::array<float, 256> srgb = decoding_table(TexelSpace::kSrgb);
    static const std::array<float, 256> linear = decoding_table(TexelSpace::kLinear);
    return space == TexelSpace::kSrgb ? srgb : linear;
}

/// For a value in [0, 1] the nearest sRGB code, as the device would round it: halfway between two
/// codes on the encoded scale.
std::uint8_t srgb_encoded(float value)
{
    static const std::array<float, 256> upper_ends = [] {
        std::array<float, 256> ends{};
        for (std::size_t i = 0; i < ends.size(); ++i)
            ends[i] = static_cast<float>(srgb_decoded((static_cast<double>(i) + 0.5) / 255));
        return ends;
    }();
    const auto* const end = std::upper_bound(upper_ends.begin(), upper_ends.end() - 1, value);
    return static_cast<std::uint8_t>(end - upper_ends.begin());
}

std::uint8_t encoded(float value, TexelSpace space)
{
    const float clamped = std::clamp(value, 0.0F, 1.0F);
    return space == TexelSpace::kSrgb ? srgb_encoded(clamped)
                                      : static_cast<std::uint8_t>(std::lround(clamped * 255));
}

struct LinearImage {
    std::uint32_t width;
    std::uint32_t height;
    std::vector<glm::vec4> texels;
};

/// Which texels a box covers along one axis, and how much of each.
struct Coverage {
    std::uint32_t first;
    std::array<float, 3> weights{};  ///< Sum 1; a box is never wider than 3 texels.
};

std::vector<Coverage> coverage(std::uint32_t from, std::uint32_t to)
{
    std::vector<Coverage> boxes(to);
    const double size = static_cast<double>(from) / to;
    for (std::uint32_t i = 0; i < to; ++i) {
        const double lower = i * size;
        const double upper = lower + size;
        boxes[i].first = std::min(static_cast<std::uint32_t>(lower), from - 1);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const double texel = boxes[i].first + k;
            const double covered = std::min(upper, texel + 1) - std::max(lower, texel);
            boxes[i].weights[k] =
                texel < from ? static_cast<float>(std::max(covered, 0.0) / size) : 0;
        }
    }
    return boxes;
}

LinearImage halved(const LinearImage& image)
{
    LinearImage half{std::max(image.width / 2, 1U), std::max(image.height / 2, 1U), {}};
    half.texels.reserve(std::size_t{half.width} * half.height);
    const std::vector<Coverage> columns = coverage(image.width, half.width);
    for (const Coverage& row : coverage(image.height, half.height))
        for (const Coverage& column : columns) {
            glm::vec4 sum(0);
            for (std::uint32_t y = 0; y < 3; ++y) {
                if (row.weights[y] == 0)
                    continue;
                const std::size_t line = std::size_t{row.first + y} * image.width + column.first;
                for (std::uint32_t x = 0; x < 3; ++x)
                    if (column.weights[x] > 0)
                        sum += row.weights[y] * column.weights[x] * image.texels[line + x];
            }
            half.texels.push_back(sum);
        }
    return half;
}

Image8 stored(const LinearImage& image, TexelSpace space)
{
    Image8 result{{}, image.width, image.height, {}};
    result.texels.reserve(image.texels.size());
    for (const glm::vec4& t : image.texels)
        result.texels.emplace_back(encoded(t.x, space), encoded(t.y, space), encoded(t.z, space),
            encoded(t.w, TexelSpace::kLinear));
    return result;
}

}  // namespace

glm::vec4 decoded(const glm::u8vec4& texel, TexelSpace space)
{
    const std::array<float, 256>& table = codes(space);
    return {table[texel.x], table[texel.y], table[texel.z], codes(TexelSpace::kLinear)[texel.w]};
}

std::vector<Image8> mip_levels(const Image8& image, TexelSpace space)
{
    assert(image.width > 0 && image.height > 0);
    assert(image.texels.size() == std::size_t{image.width} * image.height);
    std::vector<Image8> levels{image};
    LinearImage level{image.width, image.height, {}};
    level.texels.reserve(image.texels.size());
    for (const glm::u8vec4& texel : image.texels)
        level.texels.push_back(decoded(texel, space));
    while (level.width > 1 || level.height > 1) {
        level = halved(level);
        levels.push_back(stored(level, space));
    }
    return levels;
}

glm::vec4 mean_texel(const Image8& image, TexelSpace space)
{
    glm::dvec4 sum(0);
    for (const glm::u8vec4& texel : image.texels)
        sum += glm::dvec4(decoded(texel, space));
    return sum / static_cast<double>(std::max<std::size_t>(image.texels.size(), 1));
}

}  // namespace farlight
