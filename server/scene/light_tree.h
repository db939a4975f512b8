// A tree over lights by place, direction and intensity: a shader descends it to choose a light that
// matters where it stands.
//
// Sources: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree
// Splitting"; Pharr et al. 2023, "Physically Based Rendering", 4th ed., section 12.6.3.
#pragma once

#include "server/scene/lights.h"
#include "server/scene/texels.h"

#include <span>

namespace farlight {

/// From as many lights with a place on there is a tree. Measured on llvmpipe: asking a tree over 4
/// lights takes as long as drawing by power, over 16 a frame takes a tenth to a third longer; where
/// the lights are near enough for it to matter, the same error is reached 4 to 50 times as fast.
constexpr std::size_t kLightTreeFrom = 4;

struct LightTree {
    Texels nodes;  ///< Layout: `light_tree` in shaders/shared/scene_layout.h, without the header.
    /// One a light: the way to its leaf from the root, lowest bit first; 1: the second child.
    std::vector<std::uint32_t> trails;
};

/// `lights[i]` has index `indices[i]` in the table and has a place. 2 n - 1 nodes, whatever the
/// lights; at most 32 levels below the root.
LightTree build_light_tree(std::span<const Light> lights, std::span<const std::uint32_t> indices);

}  // namespace farlight
