// The top of a two-level tree: over instances and the roots of trees in world space. Rebuilt
// whenever something moved, in a region of the nodes that any build fits into.
#pragma once

#include "server/scene/bvh.h"

namespace farlight {

struct TopLevelEntry {
    PrimitiveBounds bounds;  ///< In world space.
    std::uint32_t word = 0;  ///< What stands for it in a node: an instance's leaf, or a root.
};

/// Texels that any tree over so many entries fits into.
std::size_t top_level_texels(std::size_t entries);

/// Stack that the traversal of any such tree can need, not counting what is below the entries.
int top_level_stack(std::size_t entries);

/// Builds by the surface area heuristic, and by medians where the heuristic would need more stack
/// than top_level_stack(). Fills all top_level_texels(entries.size()); `nodes` must hold as many.
void build_top_level(std::span<TopLevelEntry> entries, std::span<glm::uvec4> nodes);

}  // namespace farlight
