// Reference: glTF 2.0 specification, section 3.8 "Texture Data"; KHR_texture_transform.
#include "server/scene/gltf_texture.h"

#include "server/scene/texture_transform.h"

#include <cmath>

namespace farlight {

namespace {

using Json = nlohmann::json;

constexpr int kNearest = 9728;
constexpr int kNearestInMipmap = 9984;
constexpr int kNearestOfTwoMipmaps = 9986;
constexpr int kClampToEdge = 33071;
constexpr int kMirroredRepeat = 33648;

/// A float times this still tells texels of the largest image apart by a few.
constexpr double kLargestTransform = 1e6;

Wrap wrap_of(const Json& sampler, const char* key)
{
    switch (sampler.value(key, 0)) {
    case kClampToEdge: return Wrap::kClamp;
    case kMirroredRepeat: return Wrap::kMirror;
    default: return Wrap::kRepeat;
    }
}

bool is_nearest(int min_filter)
{
    return min_filter == kNearest || min_filter == kNearestInMipmap
        || min_filter == kNearestOfTwoMipmaps;
}

glm::mat3 image_from_uv(const Json& transform, const ScenePlace& place)
{
    const auto vec2 = [&](const char* key, double fallback) {
        const Json value = transform.value(key, Json::array({fallback, fallback}));
        return glm::dvec2(value[0].get<double>(), value[1].get<double>());
    };
    const glm::dvec2 scale = vec2("scale", 1);
    const glm::dvec2 offset = vec2("offset", 0);
    const double angle = transform.value("rotation", 0.0);
    if (!(glm::length(scale) <= kLargestTransform && glm::length(offset) <= kLargestTransform
            && std::abs(angle) <= kLargestTransform))
        refuse(place, "a texture transform beyond 1e6", "numbers of at most 1e6 in magnitude");
    return texture_transform(offset, static_cast<float>(angle), scale);
}

}  // namespace

Texture GltfTextures::read(const Json& owner, const char* key, const ScenePlace& place)
{
    Texture texture;
    const auto reference = owner.find(key);
    if (reference == owner.end())
        return texture;
    const Json& found = gltf_.item("textures", (*reference)["index"], place / key / "index");
    const ScenePlace texture_place =
        gltf_.root / "textures" / (*reference)["index"].get<std::size_t>();
    if (!found.contains("source")) {
        ++without_image_;
        return texture;
    }
    std::uint64_t uv_set = reference->value("texCoord", 0U);
    if (const Json* transform = gltf_extension(*reference, "KHR_texture_transform")) {
        texture.image_from_uv =
            image_from_uv(*transform, place / key / "extensions" / "KHR_texture_transform");
        uv_set = transform->value("texCoord", uv_set);
    }
    if (uv_set > 1) {
        ++other_uv_sets_;
        uv_set = 0;
    }
    texture.uv_set = static_cast<std::uint8_t>(uv_set);
    if (found.contains("sampler")) {
        const Json& sampler = gltf_.item("samplers", found["sampler"], texture_place / "sampler");
        texture.wrap_u = wrap_of(sampler, "wrapS");
        texture.wrap_v = wrap_of(sampler, "wrapT");
        texture.nearest = sampler.value("magFilter", 0) == kNearest;
        smoothed_ += !texture.nearest && is_nearest(sampler.value("minFilter", 0)) ? 1 : 0;
    }
    texture.image = images_.read(found["source"], texture_place / "source");
    return texture;
}

std::vector<std::string> GltfTextures::notes() const
{
    std::vector<std::string> notes;
    if (without_image_ > 0)
        notes.push_back(std::to_string(without_image_)
            + " uses of textures without a PNG or JPEG image left out");
    if (other_uv_sets_ > 0)
        notes.push_back(std::to_string(other_uv_sets_)
            + " uses of textures read with UV set 0: only sets 0 and 1 are read");
    if (smoothed_ > 0)
        notes.push_back(std::to_string(smoothed_)
            + " uses of textures with a minFilter of NEAREST smoothed where they shrink: only "
              "magFilter is read");
    return notes;
}

}  // namespace farlight
