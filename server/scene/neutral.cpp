// Tracks first (they may switch something off for good), then shapes, then materials, then what
// surrounds all.
#include "server/scene/neutral.h"

#include "server/host_guard.h"
#include "server/scene/deform.h"
#include "server/scene/material_response.h"
#include "server/scene/texture_mips.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace farlight {
namespace {

const HostGuard flat_normal_map_is_none("flat_normal_map_is_none");
const HostGuard map_of_one_color_is_none("map_of_one_color_is_none");

// ---------------------------------------------------------------- tracks

/// The value that the track holds at all times, if it never changes.
std::optional<std::vector<float>> constant_value(const Track& track)
{
    const bool cubic = track.interpolation == Track::Interpolation::kCubic;
    const std::size_t width = width_of(track);
    const std::size_t stride = cubic ? 3 * width : width;
    const std::size_t first = cubic ? width : 0;
    const bool single = track.times.size() == 1;
    for (std::size_t i = 0; i < track.values.size(); ++i) {
        const std::size_t at = i % stride;
        const bool is_value = at >= first && at < first + width;
        // One key has no span in which its tangents could act.
        const float expected = is_value ? track.values[first + (at - first)] : 0;
        if (!(track.values[i] == expected) && !(single && !is_value))
            return std::nullopt;
    }
    const auto begin = track.values.begin() + static_cast<std::ptrdiff_t>(first);
    return std::vector<float>(begin, begin + static_cast<std::ptrdiff_t>(width));
}

/// Gives what the track drives the value that it always has.
void fold(Scene& scene, const Track& track, const std::vector<float>& value)
{
    const auto xyz = [&] { return glm::dvec3(value[0], value[1], value[2]); };
    switch (track.target) {
    case Track::Target::kTranslation: scene.animation.nodes[track.index].translation = xyz(); break;
    case Track::Target::kRotation:
        scene.animation.nodes[track.index].rotation =
            glm::normalize(glm::dquat(value[3], value[0], value[1], value[2]));
        break;
    case Track::Target::kScale: scene.animation.nodes[track.index].scale = xyz(); break;
    case Track::Target::kMorphWeights:
        if (auto* instance = std::get_if<MeshInstance>(&scene.objects[track.index].shape))
            instance->morph_weights = value;
        break;
    case Track::Target::kMaterialEmission: scene.materials[track.index].emission *= value[0]; break;
    case Track::Target::kLightIntensity: scene.lights[track.index].intensity *= value[0]; break;
    case Track::Target::kBackground: scene.background *= value[0]; break;
    }
}

/// Whether the track multiplies what is zero anyway.
bool drives_nothing(const Scene& scene, const Track& track)
{
    switch (track.target) {
    case Track::Target::kMaterialEmission: return is_black(scene.materials[track.index].emission);
    case Track::Target::kLightIntensity: return is_black(scene.lights[track.index].intensity);
    case Track::Target::kBackground: return is_black(scene.background);
    default: return false;
    }
}

void drop_constant_tracks(Scene& scene)
{
    auto& tracks = scene.animation.tracks;
    tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                     [&](const Track& track) {
                         const auto value = constant_value(track);
                         if (value)
                             fold(scene, track, *value);
                         return value.has_value();
                     }),
        tracks.end());
}

void drop_idle_tracks(Scene& scene)
{
    auto& tracks = scene.animation.tracks;
    tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                     [&](const Track& track) { return drives_nothing(scene, track); }),
        tracks.end());
}

// ---------------------------------------------------------------- textures

/// Least and greatest value of each channel of an image.
struct Range {
    glm::u8vec4 least{255};
    glm::u8vec4 most{0};
};

Range range_of(const Image8& image)
{
    Range range;
    for (const glm::u8vec4& texel : image.texels) {
        range.least = glm::min(range.least, texel);
        range.most = glm::max(range.most, texel);
    }
    return range;
}

glm::vec3 linear_color(const glm::u8vec4& texel)
{
    return glm::vec3(decoded(texel, TexelSpace::kSrgb));
}

glm::vec4 linear_value(const glm::u8vec4& texel)
{
    return decoded(texel, TexelSpace::kLinear);
}

/// Flat up to the rounding of 8 bits: 127 and 128 stand for 0, 254 and 255 for 1.
bool is_flat(const Range& range)
{
    return range.least.x >= 127 && range.most.x <= 128 && range.least.y >= 127
        && range.most.y <= 128 && range.least.z >= 254;
}

/// Simplifies the materials of one scene.
class Materials {
public:
    explicit Materials(Scene& scene) : scene_(scene), ranges_(scene.images.size())
    {
        std::vector<std::uint8_t> used(scene.materials.size(), 0);
        least_vertex_alpha_.assign(scene.materials.size(), 1.0F);
        greatest_vertex_alpha_.assign(scene.materials.size(), 0.0F);
        for (const Object& object : scene.objects) {
            used[object.material] = 1;
            if (const auto* instance = std::get_if<MeshInstance>(&object.shape))
                for (const glm::vec4& color : scene.meshes[instance->mesh].colors)
                    least_vertex_alpha_[object.material] =
                        std::min(least_vertex_alpha_[object.material], color.w);
            greatest_vertex_alpha_[object.material] =
                std::max(greatest_vertex_alpha_[object.material], greatest_vertex_alpha(object));
        }
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            Material& material = scene.materials[i];
            if (used[i] != 0 && is_hole_all_over(material, greatest_vertex_alpha_[i]))
                material =
                    Material{.name = material.name, .alpha_mode = AlphaMode::kBlend, .opacity = 0};
            else if (used[i] != 0)
                simplify(material, least_vertex_alpha_[i]);
            else
                material = Material{.name = material.name};
        }
    }

private:
    void simplify(Material& m, float vertex_alpha)
    {
        if (m.unlit)
            m = Material{.name = m.name,
                .albedo = m.albedo,
                .albedo_texture = m.albedo_texture,
                .alpha_mode = m.alpha_mode,
                .opacity = m.opacity,
                .alpha_cutoff = m.alpha_cutoff,
                .unlit = true};
        simplify_alpha(m, vertex_alpha);
        simplify_surface(m);
        simplify_transmission(m);
        simplify_clearcoat(m);
    }

    float greatest_vertex_alpha(const Object& object) const
    {
        const auto* instance = std::get_if<MeshInstance>(&object.shape);
        if (instance == nullptr || scene_.meshes[instance->mesh].colors.empty())
            return 1;
        float greatest = 0;
        for (const glm::vec4& color : scene_.meshes[instance->mesh].colors)
            greatest = std::max(greatest, color.w);
        return greatest;
    }

    /// What is not there anywhere, for any ray.
    bool is_hole_all_over(const Material& m, float vertex_alpha)
    {
        const float texture_alpha =
            m.albedo_texture.used() ? linear_value(range(m.albedo_texture).most).w : 1;
        const float most = m.opacity * texture_alpha * vertex_alpha;
        return (m.alpha_mode == AlphaMode::kBlend && !(most > 0))
            || (m.alpha_mode == AlphaMode::kMask && !(most >= m.alpha_cutoff));
    }

    void simplify_alpha(Material& m, float vertex_alpha)
    {
        const float texture_alpha =
            m.albedo_texture.used() ? linear_value(range(m.albedo_texture).least).w : 1;
        const float least = m.opacity * texture_alpha * vertex_alpha;
        if (m.alpha_mode == AlphaMode::kOpaque || (m.alpha_mode == AlphaMode::kBlend && least >= 1)
            || (m.alpha_mode == AlphaMode::kMask && least >= m.alpha_cutoff)) {
            m.alpha_mode = AlphaMode::kOpaque;
            m.opacity = 1;
        }
        // What is opaque looks at no alpha: its texture may vary in that alone.
        if (const auto texel = uniform(m.albedo_texture, m.alpha_mode == AlphaMode::kOpaque)) {
            m.albedo *= linear_color(*texel);
            if (m.alpha_mode != AlphaMode::kOpaque)
                m.opacity *= linear_value(*texel).w;
            m.albedo_texture = {};
        }
    }

    void simplify_surface(Material& m)
    {
        fold_color(m.emission_texture, m.emission);
        if (is_black(m.emission))
            m.emission_texture = {};
        if (const auto texel = uniform(m.metallic_roughness_texture, true)) {
            m.roughness *= linear_value(*texel).y;
            m.metallic *= linear_value(*texel).z;
            m.metallic_roughness_texture = {};
        }
        drop_flat(m.normal_texture, m.normal_scale);
        fold_channel(m.specular_texture, m.specular, 3);
        if (!(m.specular > 0)) {
            m.specular_color = glm::vec3(1);
            m.specular_texture = m.specular_color_texture = {};
        }
        fold_color(m.specular_color_texture, m.specular_color);
        if (!(m.metallic > 0) && !(m.specular > 0) && !(m.transmission > 0)) {
            m.roughness = 1;
            m.metallic_roughness_texture = {};
        }
    }

    void simplify_transmission(Material& m)
    {
        fold_channel(m.transmission_texture, m.transmission, 0);
        if (m.transmission > 0)
            return;
        m.transmission_texture = {};
        m.thin_walled = false;
        m.absorption = glm::vec3(0);
        m.priority = 0;
    }

    void simplify_clearcoat(Material& m)
    {
        fold_channel(m.clearcoat_texture, m.clearcoat, 0);
        fold_channel(m.clearcoat_roughness_texture, m.clearcoat_roughness, 1);
        drop_flat(m.clearcoat_normal_texture, m.clearcoat_normal_scale);
        if (m.clearcoat > 0)
            return;
        m.clearcoat_roughness = 0;
        m.clearcoat_texture = m.clearcoat_roughness_texture = m.clearcoat_normal_texture = {};
    }

    const Range& range(const Texture& texture)
    {
        std::optional<Range>& known = ranges_[texture.image];
        if (!known)
            known = range_of(scene_.images[texture.image]);
        return *known;
    }

    /// The texel that all of the texture's equal.
    std::optional<glm::u8vec4> uniform(const Texture& texture, bool ignore_alpha)
    {
        if (!texture.used())
            return std::nullopt;
        const Range& r = range(texture);
        const bool equal =
            glm::u8vec3(r.least) == glm::u8vec3(r.most) && (ignore_alpha || r.least.w == r.most.w);
        return equal ? std::optional(r.least) : std::nullopt;
    }

    void fold_color(Texture& texture, glm::vec3& constant)
    {
        if (const auto texel = uniform(texture, true)) {
            constant *= linear_color(*texel);
            texture = {};
        }
    }

    void fold_channel(Texture& texture, float& constant, glm::length_t channel)
    {
        if (!texture.used() || range(texture).least[channel] != range(texture).most[channel])
            return;
        constant *= linear_value(range(texture).least)[channel];
        texture = {};
    }

    void drop_flat(Texture& texture, float scale)
    {
        if (flat_normal_map_is_none && texture.used() && (scale == 0 || is_flat(range(texture))))
            texture = {};
    }

    Scene& scene_;
    std::vector<std::optional<Range>> ranges_;  ///< Of each image, once asked for.
    std::vector<float> least_vertex_alpha_;  ///< Of each material's objects.
    std::vector<float> greatest_vertex_alpha_;
};

// ---------------------------------------------------------------- the rest

void drop_white_colors(Scene& scene)
{
    for (Mesh& mesh : scene.meshes)
        if (std::all_of(mesh.colors.begin(), mesh.colors.end(),
                [](const glm::vec4& color) { return color == glm::vec4(1); }))
            mesh.colors.clear();
}

void drop_uniform_environment(Scene& scene)
{
    if (scene.environment) {
        const auto& texels = scene.environment->texels;
        const bool equal = std::all_of(texels.begin(), texels.end(),
            [&](const glm::vec3& texel) { return texel == texels[0]; });
        if (map_of_one_color_is_none && equal) {
            scene.background *= texels.empty() ? glm::vec3(0) : texels[0];
            scene.environment.reset();
        }
    }
    if (is_black(scene.background))
        scene.environment.reset();
}

}  // namespace

void drop_neutral(Scene& scene)
{
    drop_constant_tracks(scene);
    settle_morphs(scene);
    drop_white_colors(scene);
    const Materials simplified(scene);
    drop_uniform_environment(scene);
    drop_idle_tracks(scene);
    if (is_black(scene.medium.sigma_a + scene.medium.sigma_s))
        scene.medium = {};
    if (!(scene.lens.radius > 0))
        scene.lens = {};
}

}  // namespace farlight
