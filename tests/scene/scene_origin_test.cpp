// Which point a scene is counted from, and that everything in it is.
#include "server/scene/scene_origin.h"

#include "server/scene/animation.h"

#include <gmock/gmock.h>
#include <limits>

namespace farlight {
namespace {

/// A ball of radius 1 at `center`, seen from 4 away.
Scene ball_at(const glm::dvec3& center)
{
    Scene scene;
    scene.materials.push_back({"white"});
    scene.objects.push_back({"ball", 0, Sphere{center, 1}});
    scene.camera = {center + glm::dvec3(0, 0, 4), center, {0, 1, 0}, 45};
    return scene;
}

TEST(SceneOriginTest, ScenesAboutTheirOriginKeepIt)
{
    EXPECT_EQ(origin_of(Scene{}), glm::dvec3(0));
    EXPECT_EQ(origin_of(ball_at({0, 0, 0})), glm::dvec3(0));
    EXPECT_EQ(origin_of(ball_at({20, -30, 0})), glm::dvec3(0));
}

TEST(SceneOriginTest, FarScenesAreCountedFromTheGridPointNearestToWhatIsLookedAt)
{
    // Half the diagonal of its box is sqrt(3): a step of 16.
    EXPECT_EQ(origin_of(ball_at({100, -90, 3})), glm::dvec3(96, -96, 0));
    EXPECT_EQ(origin_of(ball_at({1e9, 0, 0})), glm::dvec3(1e9, 0, 0));
    // A part of a wide scene.
    Scene wide = ball_at({1e6, 7, 0});
    wide.objects.push_back({"far off", 0, Sphere{{-1e6, 0, 0}, 1}});
    EXPECT_EQ(origin_of(wide), glm::dvec3(1e6, 0, 0));
    // What is looked at counts only as far as there is a scene.
    Scene astray = ball_at({1e6, 0, 0});
    astray.camera.target = {5e6, 0, 0};
    EXPECT_NEAR(origin_of(astray).x, 1e6, 16);
}

TEST(SceneOriginTest, FollowsThePowersOfTwoThatASceneIsScaledBy)
{
    const Scene scene = ball_at({1234.5, -77777, 3});
    const glm::dvec3 origin = origin_of(scene);
    EXPECT_NE(origin, glm::dvec3(0));
    for (const double scale : {0x1p-20, 0.5, 0x1p13}) {
        Scene scaled = ball_at(scale * glm::dvec3(1234.5, -77777, 3));
        scaled.camera.position = scale * scene.camera.position;
        std::get<Sphere>(scaled.objects[0].shape).radius = scale;
        EXPECT_EQ(origin_of(scaled), scale * origin) << scale;
    }
}

TEST(SceneOriginTest, WhatHasNoBoundsHasNoOrigin)
{
    Scene scene = ball_at({1e9, 0, 0});
    std::get<Sphere>(scene.objects[0].shape).center.y = std::numeric_limits<double>::infinity();
    EXPECT_EQ(origin_of(scene), glm::dvec3(0));
    std::get<Sphere>(scene.objects[0].shape).center.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(origin_of(scene), glm::dvec3(0));
}

TEST(SceneOriginTest, AThingFartherOffThanItIsLargeMakesASceneWide)
{
    EXPECT_FALSE(is_wide(Scene{}));
    Scene scene = ball_at({0, 0, 0});
    scene.objects.push_back({"speck", 0, Sphere{{0, 0, 0}, 1e-9}});
    scene.objects.push_back({"ground", 0, Quad{{-1e6, 0, -1e6}, {2e6, 0, 0}, {0, 0, 2e6}}});
    EXPECT_FALSE(is_wide(scene)) << "what is small is where numbers are fine";
    scene.objects.push_back({"house", 0, Sphere{{0, 0, 9e5}, 5}});
    EXPECT_TRUE(is_wide(scene));
    scene.objects.back().framed = false;
    EXPECT_FALSE(is_wide(scene));
}

TEST(SceneOriginTest, FramesOfWideScenesAreCountedFromAGridPointNearTheirCamera)
{
    EXPECT_EQ(origin_near({0, 0, 0}, 1e6), glm::dvec3(0));
    EXPECT_EQ(origin_near({511, -513, 1e6}, 1e6), glm::dvec3(0, -1024, 1000448));
    EXPECT_EQ(origin_near(0.25 * glm::dvec3(511, -513, 1e6), 0.25e6),
        0.25 * origin_near({511, -513, 1e6}, 1e6));
}

TEST(SceneOriginTest, EverythingButCamerasIsCountedFromIt)
{
    const glm::dvec3 origin(1e6, -2e6, 64);
    Scene scene = ball_at(origin + glm::dvec3(1, 2, 3));
    scene.objects.push_back({"disk", 0, Disk{origin, {0, 0, 1}, 1}});
    scene.objects.push_back({"quad", 0, Quad{origin, {1, 0, 0}, {0, 1, 0}}});
    MeshInstance instance;
    instance.world_from_object[3] = glm::dvec4(origin + 5.0, 1);
    scene.objects.push_back({"mesh", 0, instance});
    scene.objects.push_back({"carried", 0, Sphere{{7, 7, 7}, 1}, true, 1});
    scene.lights.push_back({.name = "lamp", .position = origin});
    scene.lights.push_back({.name = "carried lamp", .position = {8, 8, 8}, .node = 1});
    scene.animation.nodes.push_back({.name = "root", .translation = origin, .scale = {2, 2, 2}});
    scene.animation.nodes.push_back({.name = "child", .parent = 0, .translation = {1, 0, 0}});
    const CameraPose camera = scene.camera;
    count_from(scene, origin);
    EXPECT_EQ(scene.origin, origin);
    EXPECT_EQ(scene.camera, camera);
    EXPECT_EQ(std::get<Sphere>(scene.objects[0].shape).center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(std::get<Disk>(scene.objects[1].shape).center, glm::dvec3(0));
    EXPECT_EQ(std::get<Quad>(scene.objects[2].shape).corner, glm::dvec3(0));
    EXPECT_EQ(std::get<MeshInstance>(scene.objects[3].shape).world_from_object[3],
        glm::dvec4(5, 5, 5, 1));
    EXPECT_EQ(std::get<Sphere>(scene.objects[4].shape).center, glm::dvec3(7));
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(0));
    EXPECT_EQ(scene.lights[1].position, glm::dvec3(8));
    EXPECT_EQ(pose_nodes(scene.animation, 0)[1][3], glm::dvec4(2, 0, 0, 1));
}

}  // namespace
}  // namespace farlight
