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
        nodes;  ///< BVH_NODE_TEXELS texels a node, root first (shaders/shared/scene_layout.h).
    std::vector<std::uint32_t> order;  ///< Leaf slot k holds primitive order[k].
    int stack_depth = 0;  ///< Most entries the traversal stack can ever hold.
};

enum class PrimitiveKind : std::uint8_t { kTriangle, kSphere, kDisk };
constexpr int kPrimitiveKinds = 3;

/// Builds with Embree's builder (surface area heuristic); deterministic for equal input.
///
/// Primitives may be of several kinds: each leaf holds one kind, and in `order` all of a kind stand
/// together, in the order of PrimitiveKind. Throws std::invalid_argument naming the first primitive
/// with non-finite bounds. An empty input gives a root without children.
Bvh build_bvh(std::span<const PrimitiveBounds> bounds, std::span<const PrimitiveKind> kind_of);

}  // namespace farlight
