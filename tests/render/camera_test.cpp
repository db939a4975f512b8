// Camera frames: orthonormal for every pose, and what happens where a pose has no direction.
#include "server/render/camera.h"
#include "server/render/start_size.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

void expect_orthonormal(const CameraPose& pose)
{
    const CameraBasis b = camera_basis(pose);
    for (const glm::dvec3& v : {b.right, b.up, b.forward})
        EXPECT_NEAR(glm::length(v), 1, 1e-6);
    EXPECT_NEAR(glm::dot(b.right, b.up), 0, 1e-6);
    EXPECT_NEAR(glm::dot(b.up, b.forward), 0, 1e-6);
    EXPECT_NEAR(glm::dot(glm::cross(b.forward, b.up), b.right), 1, 1e-6);
}

TEST(CameraTest, BasisIsOrthonormalEvenLookingAlongUp)
{
    for (const glm::dvec3& target :
        {glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1e-9, 1, 0),
            glm::dvec3(3, -2, 5), glm::dvec3(1e8, 1, 1)})
        expect_orthonormal({{0, 0, 0}, target, {0, 1, 0}, 45});
    expect_orthonormal({{1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 45});  // looks at itself
    expect_orthonormal({{0, 0, 0}, {0, 0, -1}, {0, 0, 0}, 45});  // no up
}

TEST(CameraTest, RightIsToTheRightOfTheView)
{
    const CameraBasis basis = camera_basis({{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45});
    EXPECT_EQ(basis.right, glm::dvec3(1, 0, 0));
    EXPECT_EQ(basis.up, glm::dvec3(0, 1, 0));
}

TEST(StartSizeTest, IsTheLargestThatFitsAndNeverTooSmallToSee)
{
    EXPECT_EQ(largest_extent_within(1e-9, 80), (Extent{1280, 720}));
    EXPECT_EQ(largest_extent_within(80.0 / (320 * 180), 80), (Extent{320, 180}));
    EXPECT_EQ(largest_extent_within(1, 80), (Extent{128, 72}));
}

}  // namespace
}  // namespace farlight
