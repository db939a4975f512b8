// Bounding volume hierarchy over primitives, built on the CPU and packed for traversal in GLSL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace farlight {

/// World-space bounds of one primitive.
struct PrimitiveBounds {
    glm::vec3 lower;
    glm::vec3 upper;
};

/// Widest node, and most primitives in a leaf (what three bits of a child word can say).
constexpr int kBvhWidth = 4;
constexpr int kBvhMaxLeaf = 4;

struct Bvh {
    std::vector<glm::uvec4>
        nodes;  ///< kBvhNodeTexels texels a node, root first; layout in geometry/bvh.glsl.
    std::vector<std::uint32_t> order;  ///< Leaf slot k holds primitive order[k].
    int stack_depth = 0;  ///< Most entries the traversal stack can ever hold.
};

/// Builds with Embree's builder (surface area heuristic); deterministic for equal input.
///
/// Primitives may be of several kinds as long as each leaf holds one kind: `kind_of[i]` in [0, 1]
/// (0 triangle, 1 sphere) keeps them apart. Throws std::invalid_argument naming the first primitive
/// with non-finite bounds. An empty input gives a root without children.
Bvh build_bvh(std::span<const PrimitiveBounds> bounds, std::span<const std::uint8_t> kind_of);

}  // namespace farlight
