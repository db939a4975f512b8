// Bytes of the same content are decoded once, wherever they come from.
#include "server/scene/gltf_image.h"

#include "server/scene/gltf_uri.h"
#include "server/scene/image_file.h"

namespace farlight {

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
        const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
        images_.push_back(decode_image({data, bytes.size()}, image_place));
        images_.back().name = image.value(
            "name", image.value("uri", "").starts_with("data:") ? "" : image.value("uri", ""));
        if (images_.back().name.empty())
            images_.back().name = "image " + std::to_string(number);
    }
    by_index_[number] = entry->second;
    return entry->second;
}

}  // namespace farlight
