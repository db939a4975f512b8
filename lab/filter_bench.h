// The filter's passes one by one over a wall that fills the view, with light made by hand.
#pragma once

#include "lab/pass_bench.h"

namespace farlight::lab {

/// View depth of the wall [m].
constexpr float kWallDepth = 10;

/// What a pixel of a wall at `depth` that faces the camera is in in_surface and prev_surface.
glm::uvec4 wall_at(float depth);

/// Pass `name` of shaders/svgf for diffuse light, settings as by default, all textures there: light
/// zero, a wall, nothing moved, no history.
std::unique_ptr<PassBench> filter_bench(const std::string& name, Extent extent);

/// The word beside a colour (shaders/svgf/noise.glsl): this variance, no half difference.
float noise_word(float variance);
float variance_of(float noise_word);

}  // namespace farlight::lab
