// The environment map as the GPU reads and samples it.
#pragma once

#include "server/scene/scene.h"
#include "server/scene/texels.h"

namespace farlight {

struct PackedEnvironment {
    Texels texels;  ///< Layout: `environment` in shaders/shared/scene_layout.h.
    glm::dvec3 mean_radiance{0};  ///< Over all directions.
};

/// A texel is sampled in proportion to the mean luminance over it, as bilinear interpolation shows
/// it, times its solid angle.
PackedEnvironment pack_environment(const EnvironmentMap& map, const glm::mat3& map_from_world);

}  // namespace farlight
