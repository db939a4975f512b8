// The packed tree's invariants. No device needed.
#include "server/scene/bvh.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

PrimitiveBounds box(const glm::vec3& center, float size)
{
    return {center - size, center + size};
}

std::vector<PrimitiveBounds> random_boxes(std::size_t count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<PrimitiveBounds> bounds;
    for (std::size_t i = 0; i < count; ++i)
        bounds.push_back(box({uniform(random), uniform(random), uniform(random)}, 0.05F));
    return bounds;
}

PrimitiveKind kind_of_leaf(unsigned word)
{
    const unsigned kind = word & BVH_KIND_MASK;
    return kind == BVH_TRIANGLES ? PrimitiveKind::kTriangle
        : kind == BVH_SPHERES    ? PrimitiveKind::kSphere
                                 : PrimitiveKind::kDisk;
}

/// Walks the packed tree; calls leaf(kind, slot, box of the leaf) for each slot. Returns the
/// deepest stack seen when every node's children are pushed but the one visited.
int walk(const Bvh& bvh,
    const std::function<void(PrimitiveKind, unsigned, const PrimitiveBounds&)>& leaf)
{
    int deepest = 0;
    const std::function<void(unsigned, int)> visit = [&](unsigned at, int pending) {
        int children = 0;
        for (int i = 0; i < kBvhWidth; ++i)
            children += bvh.nodes[at + 6][i] != BVH_NO_CHILD ? 1 : 0;
        const int waiting = pending + std::max(children - 1, 0);
        deepest = std::max(deepest, waiting);
        for (int i = 0; i < kBvhWidth; ++i) {
            const unsigned word = bvh.nodes[at + 6][i];
            if (word == BVH_NO_CHILD)
                continue;
            PrimitiveBounds b{};
            for (int axis = 0; axis < 3; ++axis) {
                b.lower[axis] =
                    glm::uintBitsToFloat(bvh.nodes[at + static_cast<unsigned>(axis)][i]);
                b.upper[axis] =
                    glm::uintBitsToFloat(bvh.nodes[at + 3 + static_cast<unsigned>(axis)][i]);
            }
            if ((word & BVH_LEAF_BIT) == 0) {
                visit(word, waiting);
                continue;
            }
            const unsigned count = ((word >> BVH_COUNT_SHIFT) & 3U) + 1;
            for (unsigned k = 0; k < count; ++k)
                leaf(kind_of_leaf(word), (word & BVH_FIRST_MASK) + k, b);
        }
    };
    visit(0, 0);
    return deepest;
}

void expect_sound(
    const std::vector<PrimitiveBounds>& bounds, const std::vector<PrimitiveKind>& kinds)
{
    const Bvh bvh = build_bvh(bounds, kinds);
    const auto first_of = [&](PrimitiveKind kind) {
        return static_cast<std::size_t>(
            std::count_if(kinds.begin(), kinds.end(), [&](PrimitiveKind k) { return k < kind; }));
    };
    std::vector<int> seen(bounds.size(), 0);
    const int deepest =
        walk(bvh, [&](PrimitiveKind kind, unsigned slot, const PrimitiveBounds& leaf) {
            const std::size_t at = slot + first_of(kind);
            ASSERT_LT(at, bvh.order.size());
            const std::uint32_t primitive = bvh.order[at];
            ++seen[primitive];
            EXPECT_EQ(kinds[primitive], kind);
            EXPECT_TRUE(glm::all(glm::lessThanEqual(leaf.lower, bounds[primitive].lower)));
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(leaf.upper, bounds[primitive].upper)));
        });
    EXPECT_EQ(seen, std::vector<int>(bounds.size(), 1)) << "every primitive in one leaf, once";
    EXPECT_EQ(bvh.stack_depth, deepest);
    EXPECT_LE(bvh.nodes.size() / BVH_NODE_TEXELS, 2 * bounds.size() + 1);
}

TEST(BvhTest, EveryPrimitiveIsInOneLeafWhoseBoxHoldsIt)
{
    for (const std::size_t count : {1U, 2U, 4U, 5U, 100U, 20'000U}) {
        const auto bounds = random_boxes(count);
        for (const PrimitiveKind kind :
            {PrimitiveKind::kTriangle, PrimitiveKind::kSphere, PrimitiveKind::kDisk})
            expect_sound(bounds, std::vector<PrimitiveKind>(count, kind));
        std::vector<PrimitiveKind> mixed(count);
        for (std::size_t i = 0; i < count; ++i)
            mixed[i] = static_cast<PrimitiveKind>(i * i % 5 % 3);
        expect_sound(bounds, mixed);
    }
}

TEST(BvhTest, CoincidentPrimitivesDoNotMakeAListOfIt)
{
    const std::vector<PrimitiveBounds> bounds(10'000, box(glm::vec3(1), 0.5F));
    expect_sound(bounds, std::vector<PrimitiveKind>(bounds.size()));
    EXPECT_LE(build_bvh(bounds, std::vector<PrimitiveKind>(bounds.size())).stack_depth, 64);
}

TEST(BvhTest, AnEmptySceneHasARootWithoutChildren)
{
    const Bvh bvh = build_bvh({}, {});
    EXPECT_EQ(bvh.nodes.size(), static_cast<std::size_t>(BVH_NODE_TEXELS));
    EXPECT_EQ(bvh.nodes[6], glm::uvec4(BVH_NO_CHILD));
    EXPECT_EQ(bvh.stack_depth, 0);
}

TEST(BvhTest, EqualInputGivesAnEqualTree)
{
    const auto bounds = random_boxes(50'000);
    const std::vector<PrimitiveKind> kinds(bounds.size());
    const Bvh first = build_bvh(bounds, kinds);
    for (int i = 0; i < 3; ++i) {
        const Bvh again = build_bvh(bounds, kinds);
        EXPECT_EQ(again.order, first.order);
        EXPECT_EQ(again.nodes, first.nodes);
    }
}

TEST(BvhTest, NonFiniteBoundsAreRefusedByName)
{
    auto bounds = random_boxes(5);
    bounds[3].upper.y = std::numeric_limits<float>::infinity();
    try {
        build_bvh(bounds, std::vector<PrimitiveKind>(5));
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("primitive 3"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace farlight
