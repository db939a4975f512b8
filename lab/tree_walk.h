// Looking into packed trees: every node and leaf, and what a leaf must hold.
#pragma once

#include "server/scene/bvh.h"
#include "server/scene/pack_geometry.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <array>
#include <span>

namespace farlight::lab {

inline bool holds(const PrimitiveBounds& box, const glm::dvec3& p)
{
    return glm::all(glm::lessThanEqual(glm::dvec3(box.lower), p))
        && glm::all(glm::greaterThanEqual(glm::dvec3(box.upper), p));
}

struct TreeFacts {
    double nodes = 0;
    int depth = 0;
    int stack = 0;  ///< Most entries that may wait.
    double outside = 0;  ///< Boxes that reach out of their parent's.
};

/// Walks a tree; calls leaf(word, box) for each.
template <typename Leaf> class TreeWalk {
public:
    TreeWalk(std::span<const glm::uvec4> nodes, const Leaf& leaf) : nodes_(nodes), leaf_(leaf) { }

    TreeFacts run()
    {
        visit(0, 1, 0, nullptr);
        return facts_;
    }

private:
    void visit(std::size_t at, int depth, int waiting, const PrimitiveBounds* parent)
    {
        facts_.nodes += 1;
        facts_.depth = std::max(facts_.depth, depth);
        int children = 0;
        for (int i = 0; i < kBvhWidth; ++i)
            children += nodes_[at + 6][i] != BVH_NO_CHILD ? 1 : 0;
        waiting += std::max(children - 1, 0);
        facts_.stack = std::max(facts_.stack, waiting);
        for (int i = 0; i < kBvhWidth; ++i) {
            const std::uint32_t word = nodes_[at + 6][i];
            if (word == BVH_NO_CHILD)
                continue;
            const PrimitiveBounds box = child_bounds(nodes_, at, static_cast<std::size_t>(i));
            const bool inside = parent == nullptr
                || (holds(*parent, glm::dvec3(box.lower)) && holds(*parent, glm::dvec3(box.upper)));
            facts_.outside += inside ? 0 : 1;
            if ((word & BVH_LEAF_BIT) != 0)
                leaf_(word, box);
            else
                visit(word, depth + 1, waiting, &box);
        }
    }

    std::span<const glm::uvec4> nodes_;
    const Leaf& leaf_;
    TreeFacts facts_;
};

inline glm::dvec3 xyz(const glm::uvec4& texel)
{
    return glm::dvec3(glm::uintBitsToFloat(glm::uvec3(texel)));
}

/// Corners of the box around primitive `slot` of a leaf of this kind, in double precision.
inline std::array<glm::dvec3, 2> extremes(
    const PackedGeometry& geometry, std::uint32_t kind, std::size_t slot)
{
    if (kind == BVH_TRIANGLES) {
        const glm::uvec4* t = &geometry.triangles[slot * TRIANGLE_TEXELS];
        return {glm::min(xyz(t[0]), glm::min(xyz(t[1]), xyz(t[2]))),
            glm::max(xyz(t[0]), glm::max(xyz(t[1]), xyz(t[2])))};
    }
    const bool sphere = kind == BVH_SPHERES;
    const glm::uvec4* p =
        sphere ? &geometry.spheres[slot * SPHERE_TEXELS] : &geometry.disks[slot * DISK_TEXELS];
    const auto radius = static_cast<double>(glm::uintBitsToFloat(p->w));
    const glm::dvec3 normal = sphere ? glm::dvec3(0) : xyz(p[1]);
    const glm::dvec3 reach = radius * glm::sqrt(glm::max(glm::dvec3(0), 1.0 - normal * normal));
    return {xyz(*p) - reach, xyz(*p) + reach};
}

}  // namespace farlight::lab
