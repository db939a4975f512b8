// Tables of what rough interfaces scatter in all, by which shaders make up for the light that GGX
// loses between facets. Integrated on the host the first time a scene has something rough.
#pragma once

#include "server/scene/texels.h"

namespace farlight {

/// Directional albedo of GGX reflection in single scattering.
struct ReflectionAlbedo {
    double total = 1;  ///< Of facets that reflect everything.
    double schlick = 0;  ///< Mean of (1 - cos)^5 over what is reflected.
};

/// `cos_o` in (0, 1], `alpha` in (0, 1].
ReflectionAlbedo reflection_albedo(double cos_o, double alpha);

/// Reflection and transmission together of a rough interface in single scattering; `eta` is the
/// index behind it over the index before it.
double dielectric_albedo(double cos_o, double alpha, double eta);

/// As bsdf/albedo_table.glsl reads them (layout: shaders/shared/scene_layout.h).
const Texels& reflection_albedo_table();
const Texels& dielectric_albedo_table();

}  // namespace farlight
