// Bounding volume hierarchy over primitives, built on the CPU and packed for traversal in GLSL.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
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

/// Where a missing child's box is: a point that no ray with t <= 1e30 reaches.
constexpr PrimitiveBounds kNowhereBounds{glm::vec3(3e37F), glm::vec3(3e37F)};

/// The box of child `child` of the node at texel `at`.
void set_child_bounds(
    std::span<glm::uvec4> nodes, std::size_t at, std::size_t child, const PrimitiveBounds& bounds);
PrimitiveBounds child_bounds(std::span<const glm::uvec4> nodes, std::size_t at, std::size_t child);

/// The box of a whole tree whose root is at texel `at`.
PrimitiveBounds root_bounds(std::span<const glm::uvec4> nodes, std::size_t at);

enum class PrimitiveKind : std::uint8_t { kTriangle, kSphere, kDisk };
constexpr int kPrimitiveKinds = 3;

/// Builds with Embree's builder (surface area heuristic); deterministic for equal input.
///
/// Primitives may be of several kinds: each leaf holds one kind, and in `order` all of a kind stand
/// together, in the order of PrimitiveKind. Throws std::invalid_argument naming the first primitive
/// with non-finite bounds. An empty input gives a root without children.
Bvh build_bvh(std::span<const PrimitiveBounds> bounds, std::span<const PrimitiveKind> kind_of);

/// Makes a tree stand at texel `node` of a buffer that holds others, its leaves' primitives of each
/// kind from `first` on.
void relocate(std::span<glm::uvec4> nodes, std::uint32_t node,
    const std::array<std::uint32_t, kPrimitiveKinds>& first);

/// Recomputes all boxes of the tree whose root is at texel `root` and whose nodes end before `end`,
/// bottom up; `leaf_bounds` gives a leaf word's. Children stand after their parents. `nodes` is the
/// part of the buffer from texel `first` on.
void refit(std::span<glm::uvec4> nodes, std::size_t first, std::size_t root, std::size_t end,
    const std::function<PrimitiveBounds(std::uint32_t)>& leaf_bounds);

}  // namespace farlight
