// What a point is inside of: spheres, closed meshes, however they are placed; no open surface.
#include "server/scene/insides.h"

#include "server/scene/mesh_repair.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

namespace farlight {
namespace {

Material liquid(float absorption, int priority = 0)
{
    Material m;
    m.transmission = 1;
    m.absorption = glm::vec3(absorption);
    m.priority = priority;
    return m;
}

glm::uvec4 entered(const Scene& scene, const glm::dvec3& point)
{
    return Insides(scene).at(point, pose_nodes(scene.animation, 0)).entered;
}

Scene of_cube(const glm::dmat4& place, std::uint32_t node = kNone)
{
    Scene scene;
    scene.materials = {liquid(1)};
    scene.meshes = {unit_cube()};
    scene.objects = {{"cube", 0, MeshInstance{0, place}, true, node}};
    return scene;
}

TEST(Insides, OfMeshesHoweverTheyArePlaced)
{
    for (const glm::dvec3& scale : {glm::dvec3(2), glm::dvec3(-2, 2, 2), glm::dvec3(2, -2, -2)}) {
        const glm::dmat4 place = glm::translate(glm::dmat4(1), {5, 0, 0})
            * glm::rotate(glm::dmat4(1), 0.3, {0, 1, 0}) * glm::scale(glm::dmat4(1), scale);
        const Scene scene = of_cube(place);
        EXPECT_EQ(entered(scene, {5.2, 0.9, -0.3}), glm::uvec4(1, 0, 0, 0));
        EXPECT_EQ(entered(scene, {5.2, 1.1, -0.3}), glm::uvec4(0));
        EXPECT_EQ(entered(scene, {0, 0, 0}), glm::uvec4(0));
    }
    Scene carried = of_cube(glm::dmat4(1), 0);
    Node node;
    node.translation = {3, 0, 0};
    node.scale = {-1, 1, 4};
    carried.animation.nodes = {node};
    EXPECT_EQ(entered(carried, {3.2, 0, 1.9}), glm::uvec4(1, 0, 0, 0));
    EXPECT_EQ(entered(carried, {0.2, 0, 0}), glm::uvec4(0));
}

TEST(Insides, AreOrderedBySizeAndTheHighestPriorityAbsorbs)
{
    Scene scene;
    for (std::uint32_t i = 0; i < 6; ++i) {
        scene.materials.push_back(liquid(static_cast<float>(i), i == 3 ? 1 : 0));
        scene.objects.push_back({"ball", i, Sphere{{0, 0, 0}, 1.0 + i}});
    }
    const Insides insides(scene);
    EXPECT_EQ(insides.at({0, 0, 3.5}, {}).entered, glm::uvec4(6, 5, 4, 0));
    EXPECT_EQ(insides.at({0, 0, 3.5}, {}).absorption.x, 3);
    EXPECT_EQ(insides.at({0, 0, 4.5}, {}).absorption.x, 4);
    EXPECT_EQ(insides.at({0, 0, 0}, {}).entered, glm::uvec4(4, 3, 2, 1));
    EXPECT_EQ(insides.at({0, 0, 9}, {}).entered, glm::uvec4(0));
    EXPECT_EQ(insides.at({0, 0, 9}, {}).absorption.x, 0);
}

TEST(Insides, HaveNoOpenSurfaceThinWallOrOpaqueThing)
{
    Scene scene = of_cube(glm::dmat4(1));
    scene.meshes[0].triangles.resize(2);  // a side
    EXPECT_EQ(entered(scene, {-0.4999, 0, 0}), glm::uvec4(0));
    scene = of_cube(glm::dmat4(1));
    EXPECT_EQ(entered(scene, {0, 0, 0}), glm::uvec4(1, 0, 0, 0));
    scene.materials[0].thin_walled = true;
    EXPECT_EQ(entered(scene, {0, 0, 0}), glm::uvec4(0));
    scene.materials[0] = Material{};
    EXPECT_EQ(entered(scene, {0, 0, 0}), glm::uvec4(0));
}

/// The shell of a vessel has no inside of its own in its hollow.
TEST(Insides, OfAShellAreItsWall)
{
    Scene scene = of_cube(glm::scale(glm::dmat4(1), glm::dvec3(2)));
    Mesh hollow = unit_cube();
    for (glm::uvec3& t : hollow.triangles)
        t = {t.x, t.z, t.y};
    scene.meshes.push_back(hollow);
    scene.objects.push_back({"hollow", 0, MeshInstance{1, glm::dmat4(1)}});
    EXPECT_EQ(entered(scene, {0, 0, 0}), glm::uvec4(0));
    EXPECT_EQ(entered(scene, {0.7, 0, 0}), glm::uvec4(1, 0, 0, 0));
}

}  // namespace
}  // namespace farlight
