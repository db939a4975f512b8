// The packed tree at its edges; what it is over other things the laboratory looks at
// (lab/cases_build.cpp).
#include "server/scene/bvh.h"
#include "shaders/shared/scene_layout.h"

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
