// Means over lights, from a level of detail of which a light covers a few texels.
#include "server/scene/light_textures.h"

#include "server/scene/flatten.h"

#include <algorithm>
#include <cmath>

namespace farlight {
namespace {

/// Texture coordinates at p0, p0 + edge_u and p0 + edge_v.
std::array<glm::vec2, 3> corner_uvs(const Scene& scene, const Light& light, std::uint8_t uv_set)
{
    const auto& shape = scene.objects[light.object].shape;
    if (std::holds_alternative<Quad>(shape))
        return light.mirrored ? std::array<glm::vec2, 3>{{{0, 1}, {0, 0}, {1, 1}}}
                              : std::array<glm::vec2, 3>{{{0, 1}, {1, 1}, {0, 0}}};
    std::array<glm::vec2, 3> uv{};
    if (const auto* instance = std::get_if<MeshInstance>(&shape)) {
        const Mesh& mesh = scene.meshes[instance->mesh];
        const std::vector<glm::vec2>& uvs = mesh.uvs[uv_set];
        const glm::uvec3 corners = wound(mesh.triangles[light.face], light.mirrored);
        for (int k = 0; k < 3 && !uvs.empty(); ++k)
            uv[static_cast<std::size_t>(k)] = uvs[corners[k]];
    }
    return uv;
}

std::int64_t wrapped(Wrap wrap, double place, std::uint32_t size)
{
    const double n = size;
    if (wrap == Wrap::kRepeat)
        place -= n * std::floor(place / n);
    if (wrap == Wrap::kMirror)
        place = n - std::abs(n - (place - 2 * n * std::floor(place / (2 * n))));
    return static_cast<std::int64_t>(std::clamp(std::floor(place), 0.0, n - 1));
}

glm::vec4 nearest(const Image8& level, const Texture& texture, const glm::dvec2& at)
{
    const auto x = wrapped(texture.wrap_u, at.x * level.width, level.width);
    const auto y = wrapped(texture.wrap_v, at.y * level.height, level.height);
    return decoded(level.texels[static_cast<std::size_t>(y * level.width + x)], TexelSpace::kSrgb);
}

/// What remains of an emitter where its texture has opacity `alpha`.
double coverage(const Material& material, double alpha)
{
    switch (material.alpha_mode) {
    case AlphaMode::kOpaque: return 1;
    case AlphaMode::kMask: return alpha >= static_cast<double>(material.alpha_cutoff) ? 1 : 0;
    case AlphaMode::kBlend: break;
    }
    return alpha;
}

glm::vec4 pair(const glm::vec2& a, const glm::vec2& b)
{
    return {a, b};
}

}  // namespace

const std::vector<Image8>& LightTextures::levels_of(std::uint32_t image)
{
    std::vector<Image8>& levels = levels_[image];
    if (levels.empty())
        levels = mip_levels(scene_.images[image], TexelSpace::kSrgb);
    return levels;
}

glm::dvec4 LightTextures::mean(const Texture& texture, const std::array<glm::vec2, 3>& uv,
    bool triangle, Detail detail, const Shown& shown)
{
    if (!texture.used())
        return shown(glm::dvec4(1));
    const std::vector<Image8>& levels = levels_of(texture.image);
    std::array<glm::dvec2, 3> at;
    for (std::size_t k = 0; k < 3; ++k)
        at[k] = glm::dvec2(glm::dmat3(texture.image_from_uv) * glm::dvec3(glm::dvec2(uv[k]), 1));
    const glm::dvec2 u = at[1] - at[0];
    const glm::dvec2 v = at[2] - at[0];
    const double texels = std::abs(u.x * v.y - u.y * v.x) * levels[0].width * levels[0].height;
    // 8 x 8 places over at most as many texels of the level.
    constexpr int kPlaces = 8;
    const double level = detail == Detail::kFinest
        ? 0
        : std::ceil(0.5 * std::log2(std::max(texels / (kPlaces * kPlaces), 1.0)));
    const Image8& image = levels[std::min(static_cast<std::size_t>(level), levels.size() - 1)];
    glm::dvec4 sum(0);
    for (int i = 0; i < kPlaces; ++i)
        for (int j = 0; j < kPlaces; ++j) {
            double s = (i + 0.5) / kPlaces;
            double t = (j + 0.5) / kPlaces;
            if (triangle && s + t > 1)
                s = 1 - s, t = 1 - t;
            sum += shown(glm::dvec4(nearest(image, texture, at[0] + s * u + t * v)));
        }
    return sum / static_cast<double>(kPlaces * kPlaces);
}

std::uint32_t LightTextures::add(Light& light)
{
    const Material& material = scene_.materials[scene_.objects[light.object].material];
    light.radiance = material.emission;
    light.emits_both_sides = material.emits_both_sides;
    const Texture& emission = material.emission_texture;
    const Texture none;
    const bool holes = material.alpha_mode != AlphaMode::kOpaque;
    const Texture& opacity = holes ? material.albedo_texture : none;
    const auto emission_uv = corner_uvs(scene_, light, emission.uv_set);
    const auto opacity_uv = corner_uvs(scene_, light, opacity.uv_set);
    const bool triangle = std::holds_alternative<MeshInstance>(scene_.objects[light.object].shape);
    const auto constant = static_cast<double>(material.opacity);
    // A mask cuts what the finest level shows: of a coarser one it would leave all or nothing.
    const Detail detail =
        material.alpha_mode == AlphaMode::kMask ? Detail::kFinest : Detail::kAveraged;
    const double there = mean(opacity, opacity_uv, triangle, detail, [&](const glm::dvec4& texel) {
        return glm::dvec4(coverage(material, constant * texel.w));
    }).w;
    const glm::dvec4 color = mean(emission, emission_uv, triangle, Detail::kAveraged,
        [](const glm::dvec4& texel) { return texel; });
    light.mean_luminance = there * luminance(glm::dvec3(material.emission) * glm::dvec3(color));
    if (!emission.used() && !opacity.used()) {
        light.radiance *= static_cast<float>(there);
        return 0;
    }
    const float cutoff = material.alpha_mode == AlphaMode::kMask ? material.alpha_cutoff : -1;
    const glm::vec4 header[] = {pair(emission_uv[0], emission_uv[1]),
        pair(emission_uv[2], opacity_uv[0]), pair(opacity_uv[1], opacity_uv[2]),
        {holes ? material.opacity : 1, cutoff, 0, 0}};
    for (const glm::vec4& row : header)
        texels_.push_back(glm::floatBitsToUint(row));
    for (const Texture* texture : {&emission, &opacity})
        for (const glm::uvec4& packed : layout_.packed(*texture, TexelSpace::kSrgb))
            texels_.push_back(packed);
    return static_cast<std::uint32_t>(texels_.size() / LIGHT_TEXTURE_TEXELS);
}

}  // namespace farlight
