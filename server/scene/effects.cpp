// The table of effects, and sets of its rows. Why a scene calls for one: effect_reasons.cpp.
#include "server/scene/effects.h"

#include "server/scene/effect_reasons.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <stdexcept>

namespace farlight {
namespace {

using std::literals::string_view_literals::operator""sv;

std::vector<Effect> make_registry()
{
    namespace why = effect_reasons;
    return {
        {"triangles", "FX_TRIANGLES", "triangle test, vertex buffer", {}, why::triangles},
        {"spheres", "FX_SPHERES", "sphere test, sphere buffer", {}, why::spheres},
        {"disks", "FX_DISKS", "disc test, disc buffer", {}, why::disks},
        {"shading_normals", "FX_SHADING_NORMALS", "interpolated normals", {"triangles"sv},
            why::shading_normals},
        {"instances", "FX_INSTANCES", "second level of the tree, transforms at hits", {},
            why::instances},
        {"motion", "FX_MOTION", "previous transforms", {"instances"sv}, why::motion},
        {"deformation", "FX_DEFORMATION", "previous vertices", {"triangles"sv}, why::deformation},
        {"lights", "FX_LIGHTS", "light table, sampling, shadow rays, MIS", {}, why::lights},
        {"polygon_lights", "FX_POLYGON_LIGHTS", "sampling of quads", {"lights"sv, "triangles"sv},
            why::polygon_lights},
        {"sphere_lights", "FX_SPHERE_LIGHTS", "sampling of cones", {"lights"sv, "spheres"sv},
            why::sphere_lights},
        {"disk_lights", "FX_DISK_LIGHTS", "sampling of discs", {"lights"sv, "disks"sv},
            why::disk_lights},
        {"emissive_meshes", "FX_EMISSIVE_MESHES", "sampling of emissive triangles",
            {"lights"sv, "triangles"sv}, why::emissive_meshes},
        {"delta_lights", "FX_DELTA_LIGHTS", "point, spot and directional lights", {"lights"sv},
            why::delta_lights},
        {"light_tree", "FX_LIGHT_TREE", "choice of lights by place", {"lights"sv}, why::light_tree},
        {"background", "FX_BACKGROUND", "radiance of rays that leave", {}, why::background},
        {"environment_map", "FX_ENVIRONMENT_MAP", "map, its sampling table and density",
            {"background"sv, "lights"sv}, why::environment_map},
        {"textures", "FX_TEXTURES", "texture arrays, texture coordinates, ray cones", {},
            why::textures},
        {"second_uvs", "FX_SECOND_UVS", "second set of texture coordinates",
            {"textures"sv, "triangles"sv}, why::second_uvs},
        {"normal_maps", "FX_NORMAL_MAPS", "tangents, perturbed normals", {"textures"sv},
            why::normal_maps},
        {"vertex_colors", "FX_VERTEX_COLORS", "colour buffer", {"triangles"sv}, why::vertex_colors},
        {"rough_reflection", "FX_ROUGH_REFLECTION", "GGX lobe, its energy tables", {},
            why::rough_reflection},
        {"mirror", "FX_MIRROR", "mirror lobe", {}, why::mirror},
        {"clearcoat", "FX_CLEARCOAT", "coat's lobe", {}, why::clearcoat},
        {"dielectric", "FX_DIELECTRIC", "refraction, stack of insides, absorption", {},
            why::dielectric},
        {"rough_dielectric", "FX_ROUGH_DIELECTRIC", "rough refraction", {"dielectric"sv},
            why::rough_dielectric},
        {"unlit", "FX_UNLIT", "surfaces that show their colour", {}, why::unlit},
        {"alpha", "FX_ALPHA", "coverage test at every hit candidate, shadow rays too", {},
            why::alpha},
        {"fog", "FX_FOG", "distance sampling, transmittance of every segment", {}, why::fog},
        {"lens", "FX_LENS", "aperture sampling", {}, why::lens},
        {"specular_signal", "FX_SPECULAR_SIGNAL",
            "third signal: its reprojection, histories and filter passes", {},
            why::specular_signal},
        {"antialiasing", "FX_ANTIALIASING", "jitter, its pass and history", {}, why::never,
            "antialiasing"},
        {"denoising", "", "all filter passes, moments and histories", {}, why::never, "denoiser"},
    };
}

std::size_t row_called(std::string_view name)
{
    const auto& rows = effect_registry();
    const auto found = std::find_if(
        rows.begin(), rows.end(), [&](const Effect& effect) { return effect.name == name; });
    if (found == rows.end())
        throw std::invalid_argument("no effect is called '" + std::string(name) + "'");
    return static_cast<std::size_t>(found - rows.begin());
}

/// One word of each row in `bits`, where the row has it.
std::vector<std::string_view> words_of(std::uint64_t bits, std::string_view Effect::*word)
{
    std::vector<std::string_view> words;
    const auto& rows = effect_registry();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if ((bits >> i & 1U) != 0 && !(rows[i].*word).empty())
            words.push_back(rows[i].*word);
    return words;
}

}  // namespace

const std::vector<Effect>& effect_registry()
{
    static const std::vector<Effect> effects = make_registry();
    assert(effects.size() <= 64);
    return effects;
}

std::string_view setting_of(std::string_view effect)
{
    return effect_registry()[row_called(effect)].setting;
}

EffectMask mask_of_row(std::size_t row)
{
    return EffectMask(std::uint64_t{1} << row);
}

EffectMask EffectMask::general()
{
    EffectMask mask;
    const auto& rows = effect_registry();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!rows[i].macro.empty())
            mask = mask | mask_of_row(i);
    return mask;
}

EffectMask EffectMask::of(const std::vector<std::string_view>& names)
{
    EffectMask mask;
    for (const std::string_view name : names) {
        const std::size_t row = row_called(name);
        mask = mask | mask_of_row(row) | of(effect_registry()[row].needs);
    }
    return mask;
}

bool EffectMask::has(std::string_view name_or_macro) const
{
    const auto& rows = effect_registry();
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].name == name_or_macro || rows[i].macro == name_or_macro)
            return (bits_ >> i & 1U) != 0;
    return false;
}

int EffectMask::size() const
{
    return std::popcount(bits_);
}

std::vector<std::string_view> EffectMask::names() const
{
    return words_of(bits_, &Effect::name);
}

std::vector<std::string_view> EffectMask::macros() const
{
    return words_of(bits_, &Effect::macro);
}

std::vector<ActiveEffect> active_effects(const Scene& scene, const SceneContent& content)
{
    const auto& rows = effect_registry();
    std::vector<std::string> reasons(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::optional<std::string> reason = rows[i].reason(scene, content);
        if (!reason)
            continue;
        reasons[i] = *std::move(reason);
        for (const std::string_view need : EffectMask::of(rows[i].needs).names())
            if (std::string& why = reasons[row_called(need)]; why.empty())
                why = "needed by " + std::string(rows[i].name);
    }
    std::vector<ActiveEffect> active;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!reasons[i].empty())
            active.push_back({rows[i].name, rows[i].macro, std::move(reasons[i])});
    return active;
}

EffectMask mask_of(const std::vector<ActiveEffect>& effects)
{
    EffectMask mask;
    for (const ActiveEffect& effect : effects)
        mask = mask | mask_of_row(row_called(effect.name));
    return mask;
}

}  // namespace farlight
