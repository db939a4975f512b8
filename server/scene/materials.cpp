// Packing materials into texels.
#include "server/scene/materials.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>

namespace farlight {
namespace {

std::uint32_t flags_of(const Material& material)
{
    std::uint32_t flags = 0;
    flags |= material.emits_both_sides ? MATERIAL_EMITS_BOTH_SIDES : 0;
    flags |= material.unlit ? MATERIAL_UNLIT : 0;
    flags |= material.thin_walled ? MATERIAL_THIN_WALLED : 0;
    flags |= material.alpha_mode == AlphaMode::kMask ? MATERIAL_ALPHA_MASK : 0;
    return flags;
}

void pack(const Material& m, const TextureLayout& textures, glm::uvec4* texels)
{
    texels[MATERIAL_ALBEDO] = texel(m.albedo, flags_of(m));
    texels[MATERIAL_EMISSION] = texel(m.emission, bits(m.opacity));
    texels[MATERIAL_BASE] =
        glm::floatBitsToUint(glm::vec4(m.metallic, m.roughness, m.specular, m.ior));
    texels[MATERIAL_SPECULAR] = texel(m.specular_color, bits(m.transmission));
    texels[MATERIAL_INSIDE] = texel(m.absorption, static_cast<std::uint32_t>(m.priority));
    texels[MATERIAL_COAT] = glm::floatBitsToUint(
        glm::vec4(m.clearcoat, m.clearcoat_roughness, m.normal_scale, m.alpha_cutoff));
    texels[MATERIAL_COAT_NORMAL] = {bits(m.clearcoat_normal_scale), 0, 0, 0};
    // each_texture() visits them in the order of MAP_*.
    std::uint32_t map = 0;
    each_texture(m, [&](const Texture& texture, TexelSpace space) {
        const PackedTexture reference = textures.packed(texture, space);
        std::copy(reference.begin(), reference.end(),
            texels + MATERIAL_TEXTURES + static_cast<std::ptrdiff_t>(map * TEXTURE_TEXELS));
        if (texture.used())
            texels[MATERIAL_ALBEDO].w |= 1U << (MATERIAL_MAP_SHIFT + map);
        ++map;
    });
}

}  // namespace

Texels pack_materials(const std::vector<Material>& materials, const TextureLayout& textures)
{
    Texels texels(materials.size() * MATERIAL_TEXELS);
    for (std::size_t i = 0; i < materials.size(); ++i)
        pack(materials[i], textures, &texels[i * MATERIAL_TEXELS]);
    return texels;
}

bool scatters_roughly(const std::vector<Material>& materials)
{
    return std::any_of(materials.begin(), materials.end(), [](const Material& m) {
        const bool base = m.metallic > 0 || m.specular > 0 || m.transmission > 0;
        const bool rough_base =
            m.metallic_roughness_texture.used() || m.roughness > MIRROR_ROUGHNESS;
        const bool rough_coat =
            m.clearcoat_roughness_texture.used() || m.clearcoat_roughness > MIRROR_ROUGHNESS;
        return !m.unlit && ((base && rough_base) || (m.clearcoat > 0 && rough_coat));
    });
}

}  // namespace farlight
