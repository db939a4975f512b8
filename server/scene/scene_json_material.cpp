// Keys are named like the members of Material; a test reads every one of them back.
#include "server/scene/scene_json_material.h"

#include "server/scene/scene_json_values.h"
#include "server/scene/texture_transform.h"

#include <algorithm>
#include <array>

namespace farlight {

namespace {

using Json = nlohmann::json;

void read_number(const Json& value, const char* key, float& number)
{
    number = value.value(key, number);
}

void read_color(const Json& value, const char* key, glm::vec3& color)
{
    color = vec3_or(value, key, color);
}

glm::vec2 vec2_or(const Json& value, const char* key, const glm::vec2& fallback)
{
    const auto found = value.find(key);
    return found == value.end() ? fallback
                                : glm::vec2((*found)[0].get<float>(), (*found)[1].get<float>());
}

AlphaMode alpha_mode(const Json& value)
{
    const std::string name =
        value.value("alpha_mode", value.contains("opacity") ? "blend" : "opaque");
    return name == "mask" ? AlphaMode::kMask
        : name == "blend" ? AlphaMode::kBlend
                          : AlphaMode::kOpaque;
}

Wrap wrap(const Json& value)
{
    const auto& name = value.get_ref<const std::string&>();
    return name == "mirror" ? Wrap::kMirror : name == "clamp" ? Wrap::kClamp : Wrap::kRepeat;
}

/// Whoever speaks of a polish has one: such a material reflects like glTF's unless it says how
/// much.
bool speaks_of_reflection(const Json& value)
{
    constexpr std::array kWords{"roughness", "ior", "transmission", "specular_color",
        "metallic_roughness_texture", "specular_texture", "specular_color_texture"};
    return std::any_of(
        kWords.begin(), kWords.end(), [&](const char* word) { return value.contains(word); });
}

}  // namespace

void SceneMaterials::read(const Json& materials, const ScenePlace& place)
{
    for (const auto& [name, value] : materials.items()) {
        by_name_[name] = static_cast<std::uint32_t>(scene_.materials.size());
        Material material = read_material(value, place / name);
        material.name = name;
        scene_.materials.push_back(std::move(material));
    }
}

std::uint32_t SceneMaterials::at(const std::string& name, const ScenePlace& place) const
{
    const auto known = by_name_.find(name);
    if (known != by_name_.end())
        return known->second;
    std::vector<std::string> names;
    for (const auto& [declared, index] : by_name_)
        names.push_back(declared);
    refuse(place, "the unknown material " + in_quotes(name), one_of(names, "/materials"));
}

Material SceneMaterials::read_material(const Json& value, const ScenePlace& place)
{
    Material material;
    read_color(value, "albedo", material.albedo);
    read_color(value, "emission", material.emission);
    material.emits_both_sides = value.value("emits_both_sides", false);
    material.alpha_mode = alpha_mode(value);
    read_number(value, "opacity", material.opacity);
    read_number(value, "alpha_cutoff", material.alpha_cutoff);
    read_number(value, "metallic", material.metallic);
    read_number(value, "roughness", material.roughness);
    read_number(value, "normal_scale", material.normal_scale);
    read_number(value, "ior", material.ior);
    material.specular = value.value("specular", speaks_of_reflection(value) ? 1.0F : 0.0F);
    read_color(value, "specular_color", material.specular_color);
    read_number(value, "transmission", material.transmission);
    material.thin_walled = value.value("thin_walled", false);
    read_color(value, "absorption", material.absorption);
    material.priority = value.value("priority", 0);
    read_number(value, "clearcoat", material.clearcoat);
    read_number(value, "clearcoat_roughness", material.clearcoat_roughness);
    read_number(value, "clearcoat_normal_scale", material.clearcoat_normal_scale);
    material.unlit = value.value("unlit", false);
    using Slot = std::pair<const char*, Texture*>;
    for (const auto& [key, texture] : {Slot{"albedo_texture", &material.albedo_texture},
             Slot{"emission_texture", &material.emission_texture},
             Slot{"metallic_roughness_texture", &material.metallic_roughness_texture},
             Slot{"normal_texture", &material.normal_texture},
             Slot{"specular_texture", &material.specular_texture},
             Slot{"specular_color_texture", &material.specular_color_texture},
             Slot{"transmission_texture", &material.transmission_texture},
             Slot{"clearcoat_texture", &material.clearcoat_texture},
             Slot{"clearcoat_roughness_texture", &material.clearcoat_roughness_texture},
             Slot{"clearcoat_normal_texture", &material.clearcoat_normal_texture}})
        if (value.contains(key))
            *texture = read_texture(value[key], place / key);
    return material;
}

Texture SceneMaterials::read_texture(const Json& value, const ScenePlace& place)
{
    const auto& file = value["file"].get_ref<const std::string&>();
    const auto [known, is_new] =
        image_by_file_.try_emplace(file, static_cast<std::uint32_t>(scene_.images.size()));
    if (is_new)
        scene_.images.push_back(*files_.image(file, place / "file"));
    Texture texture;
    texture.image = known->second;
    if (value.contains("wrap")) {
        const Json& wraps = value["wrap"];
        texture.wrap_u = wrap(wraps.is_array() ? wraps[0] : wraps);
        texture.wrap_v = wrap(wraps.is_array() ? wraps[1] : wraps);
    }
    texture.nearest = value.value("nearest", false);
    texture.uv_set = value.value("uv_set", std::uint8_t{0});
    texture.image_from_uv = texture_transform(vec2_or(value, "offset", glm::vec2(0)),
        glm::radians(value.value("rotation_degrees", 0.0F)), vec2_or(value, "scale", glm::vec2(1)));
    return texture;
}

}  // namespace farlight
