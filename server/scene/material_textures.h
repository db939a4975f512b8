// All textures of a material, for who treats them alike.
#pragma once

#include "server/scene/scene.h"

#include <array>

namespace farlight {

/// Pointers to the textures of a Material or a const one.
template <typename AnyMaterial> auto textures_of(AnyMaterial& m)
{
    return std::array{&m.albedo_texture, &m.emission_texture, &m.metallic_roughness_texture,
        &m.normal_texture, &m.specular_texture, &m.specular_color_texture, &m.transmission_texture,
        &m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture};
}

}  // namespace farlight
