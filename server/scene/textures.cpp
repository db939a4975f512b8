// Grouping images into arrays, and packing references to them.
#include "server/scene/textures.h"

#include "server/gl/gl_error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace farlight {
namespace {

constexpr std::size_t kBytesPerTexel = 4;

std::string size_text(std::uint32_t width, std::uint32_t height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

/// What two arrays would be as one.
TextureArrayLayout merged(const TextureArrayLayout& a, const TextureArrayLayout& b)
{
    TextureArrayLayout both{
        a.space, std::max(a.width, b.width), std::max(a.height, b.height), a.images};
    both.images.insert(both.images.end(), b.images.begin(), b.images.end());
    return both;
}

/// Joins the two arrays that waste the least when joined. False when no two may be.
bool join_cheapest(std::vector<TextureArrayLayout>& arrays, const TextureLimits& limits)
{
    std::size_t least = std::numeric_limits<std::size_t>::max();
    std::size_t first = 0;
    std::size_t second = 0;
    for (std::size_t i = 0; i < arrays.size(); ++i)
        for (std::size_t j = i + 1; j < arrays.size(); ++j) {
            if (arrays[i].space != arrays[j].space
                || arrays[i].images.size() + arrays[j].images.size() > limits.layers)
                continue;
            const std::size_t waste =
                merged(arrays[i], arrays[j]).bytes() - arrays[i].bytes() - arrays[j].bytes();
            if (waste < least)
                least = waste, first = i, second = j;
        }
    if (second == 0)
        return false;
    arrays[first] = merged(arrays[first], arrays[second]);
    arrays.erase(arrays.begin() + static_cast<std::ptrdiff_t>(second));
    return true;
}

/// Appends arrays of at most `layers` layers.
void split(
    const TextureArrayLayout& group, std::size_t layers, std::vector<TextureArrayLayout>& arrays)
{
    const std::size_t count = group.images.size();
    for (std::size_t first = 0; first < count; first += layers) {
        const auto begin = group.images.begin() + static_cast<std::ptrdiff_t>(first);
        const auto size = static_cast<std::ptrdiff_t>(std::min(layers, count - first));
        arrays.push_back({group.space, group.width, group.height, {begin, begin + size}});
    }
}

std::uint32_t wrap_word(Wrap wrap)
{
    switch (wrap) {
    case Wrap::kRepeat: return TEXTURE_REPEAT;
    case Wrap::kMirror: return TEXTURE_MIRROR;
    case Wrap::kClamp: break;
    }
    return TEXTURE_CLAMP;
}

}  // namespace

std::uint32_t TextureArrayLayout::levels() const
{
    return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

std::size_t TextureArrayLayout::bytes() const
{
    std::size_t texels = 0;
    for (std::uint32_t level = 0; level < levels(); ++level)
        texels += std::size_t{std::max(width >> level, 1U)} * std::max(height >> level, 1U);
    return texels * images.size() * kBytesPerTexel;
}

void TextureLayout::need(const Texture& texture, TexelSpace space)
{
    if (!texture.used())
        return;
    assert(texture.image < images_.size());
    places_.insert({{texture.image, space}, 0});
}

void TextureLayout::lay_out(const TextureLimits& limits)
{
    std::map<std::array<std::uint32_t, 3>, TextureArrayLayout> groups;
    for (const auto& [use, place] : places_) {
        const Image8& image = images_[use.image];
        if (image.width > limits.size || image.height > limits.size)
            throw GlError("image '" + image.name + "' has " + size_text(image.width, image.height)
                + " texels, but this device allows " + size_text(limits.size, limits.size)
                + " in a texture");
        TextureArrayLayout& group = groups[{std::bit_ceil(image.width), std::bit_ceil(image.height),
            static_cast<std::uint32_t>(use.space)}];
        group.space = use.space;
        group.width = std::max(group.width, image.width);
        group.height = std::max(group.height, image.height);
        group.images.push_back(use.image);
    }
    arrays_.clear();
    for (const auto& [key, group] : groups)
        split(group, limits.layers, arrays_);
    while (arrays_.size() > TEXTURE_ARRAYS)
        if (!join_cheapest(arrays_, limits))
            throw GlError("the scene's " + std::to_string(places_.size()) + " images need "
                + std::to_string(arrays_.size()) + " texture arrays of up to "
                + std::to_string(limits.layers) + " layers (this device's limit), but "
                + std::to_string(TEXTURE_ARRAYS) + " are bound");
    for (std::uint32_t a = 0; a < arrays_.size(); ++a)
        for (std::uint32_t layer = 0; layer < arrays_[a].images.size(); ++layer)
            places_[{arrays_[a].images[layer], arrays_[a].space}] = a << 16U | layer;
}

PackedTexture TextureLayout::packed(const Texture& texture, TexelSpace space) const
{
    PackedTexture texels{};
    if (!texture.used())
        return texels;
    const Image8& image = images_[texture.image];
    const std::uint32_t place = places_.at({texture.image, space});
    const std::uint32_t word = TEXTURE_USED | (texture.nearest ? TEXTURE_NEAREST : 0)
        | (texture.uv_set != 0 ? TEXTURE_UV_SET_1 : 0)
        | wrap_word(texture.wrap_u) << TEXTURE_WRAP_U_SHIFT
        | wrap_word(texture.wrap_v) << TEXTURE_WRAP_V_SHIFT | (place >> 16U) << TEXTURE_ARRAY_SHIFT
        | (place & 0xffffU);
    const glm::mat3& m = texture.image_from_uv;
    texels[0] = {word, image.width | image.height << 16U, glm::floatBitsToUint(glm::vec2(m[2]))};
    texels[1] = {glm::floatBitsToUint(glm::vec2(m[0])), glm::floatBitsToUint(glm::vec2(m[1]))};
    return texels;
}

}  // namespace farlight
