// PNG and JPEG by stb_image, which brings 16-bit samples and grey to 8-bit RGBA.
#include "server/scene/gltf_image.h"

#include "server/scene/gltf_uri.h"

#include <cstring>
#include <memory>
#include <stb_image.h>

namespace farlight {

namespace {

constexpr int kLargestSide = 16384;  // texels: the least that current OpenGL drivers take
/// A deflated PNG of one bit a texel packs the most: 8 * 1032 texels into a byte (RFC 1951).
constexpr std::size_t kMostTexelsAByte = 8256;

void check_size(const std::string_view bytes, int width, int height, const ScenePlace& place)
{
    const std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width > kLargestSide || height > kLargestSide)
        refuse(place, "an image of " + size, "at most 16384 a side");
    if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height)
        > bytes.size() * kMostTexelsAByte)
        refuse(place, "an image of " + size + " in " + std::to_string(bytes.size()) + " bytes",
            "bytes for all of it");
}

Image8 decode(std::string_view bytes, const ScenePlace& place)
{
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = static_cast<int>(std::min<std::size_t>(bytes.size(), 0x7fffffff));
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(data, length, &width, &height, &channels) == 0)
        refuse(place, std::to_string(bytes.size()) + " bytes that are no picture", "PNG or JPEG");
    check_size(bytes, width, height, place);
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
        stbi_load_from_memory(data, length, &width, &height, &channels, 4), stbi_image_free);
    if (!texels)
        refuse(place, std::string("a broken picture: ") + stbi_failure_reason(), "PNG or JPEG");
    Image8 image;
    image.width = static_cast<std::uint32_t>(width);
    image.height = static_cast<std::uint32_t>(height);
    image.texels.resize(std::size_t(image.width) * image.height);
    std::memcpy(image.texels.data(), texels.get(), image.texels.size() * 4);
    return image;
}

}  // namespace

std::string_view GltfImages::encoded(const nlohmann::json& image, const ScenePlace& place)
{
    if (image.contains("bufferView")) {
        gltf_.item("bufferViews", image["bufferView"], place / "bufferView");
        const ByteSpan bytes = gltf_.views[image["bufferView"].get<std::size_t>()];
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    if (!image.contains("uri"))
        refuse(place, "no key \"uri\"", "a uri or a bufferView");
    return files_.emplace_back(
        read_gltf_uri(image["uri"].get<std::string>(), gltf_.folder, place / "uri"));
}

std::uint32_t GltfImages::read(const nlohmann::json& index, const ScenePlace& place)
{
    const nlohmann::json& image = gltf_.item("images", index, place);
    const auto number = index.get<std::size_t>();
    if (const auto known = by_index_.find(number); known != by_index_.end())
        return known->second;
    const ScenePlace image_place = gltf_.root / "images" / number;
    const std::string_view bytes = encoded(image, image_place);
    const auto [entry, is_new] =
        by_bytes_.try_emplace(bytes, static_cast<std::uint32_t>(images_.size()));
    if (is_new) {
        images_.push_back(decode(bytes, image_place));
        images_.back().name = image.value(
            "name", image.value("uri", "").starts_with("data:") ? "" : image.value("uri", ""));
        if (images_.back().name.empty())
            images_.back().name = "image " + std::to_string(number);
    }
    by_index_[number] = entry->second;
    return entry->second;
}

}  // namespace farlight
