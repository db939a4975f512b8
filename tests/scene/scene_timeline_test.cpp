// What moves and changes in Farlight scenes: nodes, spins, tracks of the timeline.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using testing::ElementsAre;
using testing::FloatNear;
using testing::IsEmpty;
using testing::Pointwise;

Scene parse(const std::string& timeline, const std::filesystem::path& base_dir = ".",
    const std::string& more_objects = "")
{
    return parse_scene(R"({"version": 1, "materials": {"m": {}, "lamp": {"emission": [1, 1, 1]}},
        "background": [1, 1, 1],
        "lights": {"bulb": {"intensity": [1, 1, 1], "point": {"position": [5, 6, 7]}},
                   "sun": {"intensity": [1, 1, 1], "directional": {"direction": [0, -2, 0]}}},
        "objects": [
          {"name": "ball", "material": "m", "sphere": {"center": [1, 2, 3], "radius": 1}},
          {"name": "box", "material": "m", "box": {"lower": [0, 0, 0], "upper": [2, 4, 6]}},
          {"name": "quad", "material": "m", "quad": {"corner": [1, 1, 0], "edge_u": [2, 0, 0], "edge_v": [0, 2, 0]}},
          {"name": "still", "material": "m", "disk": {"center": [9, 9, 9], "normal": [0, 3, 0], "radius": 2}})"
            + more_objects + R"(], "timeline": )" + timeline + "}",
        base_dir, "test.json");
}

const Track& only_track(const Scene& scene)
{
    EXPECT_EQ(scene.animation.tracks.size(), 1U);
    return scene.animation.tracks.at(0);
}

TEST(SceneTimeline, WhatNeverMovesHasNoNode)
{
    const Scene scene = parse("[]");
    EXPECT_TRUE(scene.animation.empty());
    EXPECT_THAT(scene.animation.nodes, IsEmpty());
    for (const Object& object : scene.objects)
        EXPECT_EQ(object.node, kNone);
}

TEST(SceneTimeline, AMovedShapeLiesAroundItsNode)
{
    const Scene scene = parse(R"([{"at": 1, "over": 2, "object": "box", "move": [10, 0, 0]},
        {"at": 1, "object": "quad", "rotate_degrees": [0, 0, 90]},
        {"at": 0, "object": "ball", "move": [0, 0, 0]}])");
    ASSERT_EQ(scene.animation.nodes.size(), 3U);
    const auto node_of = [&](std::size_t object) {
        return scene.animation.nodes.at(scene.objects[object].node);
    };
    EXPECT_EQ(node_of(0).translation, glm::dvec3(1, 2, 3));
    EXPECT_EQ(std::get<Sphere>(scene.objects[0].shape).center, glm::dvec3(0));
    EXPECT_EQ(node_of(1).translation, glm::dvec3(1, 2, 3));
    EXPECT_EQ(std::get<MeshInstance>(scene.objects[1].shape).world_from_object,
        glm::dmat4(glm::dvec4(2, 0, 0, 0), glm::dvec4(0, 4, 0, 0), glm::dvec4(0, 0, 6, 0),
            glm::dvec4(0, 0, 0, 1)));
    EXPECT_EQ(node_of(2).translation, glm::dvec3(2, 2, 0));
    EXPECT_EQ(std::get<Quad>(scene.objects[2].shape).corner, glm::dvec3(-1, -1, 0));
    EXPECT_EQ(scene.objects[3].node, kNone);
    EXPECT_EQ(std::get<Disk>(scene.objects[3].shape).normal, glm::dvec3(0, 1, 0));
}

TEST(SceneTimeline, MovesAddUpInTheOrderOfTime)
{
    const Scene scene = parse(R"([{"at": 4, "over": 1, "object": "ball", "move": [0, 0, 1]},
        {"at": 1, "over": 2, "object": "ball", "move": [10, 0, 0]}])");
    const Track& track = only_track(scene);
    EXPECT_EQ(track.target, Track::Target::kTranslation);
    EXPECT_EQ(track.index, scene.objects[0].node);
    EXPECT_EQ(track.interpolation, Track::Interpolation::kLinear);
    EXPECT_EQ(track.period, 0);
    EXPECT_THAT(track.times, ElementsAre(1, 3, 4, 5));
    EXPECT_THAT(track.values, ElementsAre(1, 2, 3, 11, 2, 3, 11, 2, 3, 11, 2, 4));
}

TEST(SceneTimeline, StepsAloneAreSteps)
{
    const Scene scene = parse(R"([{"at": 0, "light": "bulb", "on": false},
        {"at": 2, "light": "bulb", "on": true}, {"at": 3, "light": "bulb", "intensity": 0.5},
        {"at": 4, "light": "bulb", "on": false}, {"at": 5, "light": "bulb", "on": true}])");
    const Track& track = only_track(scene);
    EXPECT_EQ(track.target, Track::Target::kLightIntensity);
    EXPECT_EQ(scene.lights[track.index].name, "bulb");
    EXPECT_EQ(track.interpolation, Track::Interpolation::kStep);
    // Switched on again it is as bright as it was last.
    const std::vector<std::pair<double, float>> expected{
        {0, 0}, {1, 0}, {2, 1}, {2.5, 1}, {3, 0.5F}, {4, 0}, {4.5, 0}, {5, 0.5F}, {9, 0.5F}};
    for (const auto& [time, value] : expected) {
        const auto after = std::upper_bound(track.times.begin(), track.times.end(), time);
        ASSERT_NE(after, track.times.begin());
        EXPECT_EQ(track.values[static_cast<std::size_t>(after - track.times.begin()) - 1], value)
            << time;
    }
}

TEST(SceneTimeline, AStepAmongRampsTakesNoTime)
{
    const Scene scene = parse(R"([{"at": 1, "over": 1, "material": "lamp", "intensity": 3},
        {"at": 2, "material": "lamp", "on": false}, {"at": 4, "background": true, "intensity": 2}])");
    ASSERT_EQ(scene.animation.tracks.size(), 2U);
    const Track& background = scene.animation.tracks[0];
    EXPECT_EQ(background.target, Track::Target::kBackground);
    EXPECT_THAT(background.values, ElementsAre(1, 2));
    const Track& lamp = scene.animation.tracks[1];
    EXPECT_EQ(lamp.target, Track::Target::kMaterialEmission);
    EXPECT_EQ(scene.materials[lamp.index].name, "lamp");
    EXPECT_THAT(lamp.times, ElementsAre(1, std::nextafter(2.0, 0.0), 2));
    EXPECT_THAT(lamp.values, ElementsAre(1, 3, 0));
}

TEST(SceneTimeline, LongTurnsAreInPiecesOfAQuarter)
{
    const Scene scene =
        parse(R"([{"at": 0, "over": 8, "object": "quad", "rotate_degrees": [0, 0, 360]}])");
    const Track& track = only_track(scene);
    EXPECT_EQ(track.target, Track::Target::kRotation);
    EXPECT_THAT(track.times, ElementsAre(0, 2, 4, 6, 8));
    const float h = std::sqrt(0.5F);
    EXPECT_THAT(track.values,
        Pointwise(FloatNear(1e-6F),
            std::vector<float>{0, 0, 0, 1, 0, 0, h, h, 0, 0, 1, 0, 0, 0, h, -h, 0, 0, 0, -1}));
}

TEST(SceneTimeline, LightsMoveToo)
{
    const Scene scene = parse(R"([{"at": 0, "over": 1, "light": "bulb", "move": [1, 0, 0]},
        {"at": 0, "over": 1, "light": "sun", "rotate_degrees": [90, 0, 0]}])");
    ASSERT_EQ(scene.lights.size(), 2U);
    EXPECT_EQ(scene.animation.nodes.at(scene.lights[0].node).translation, glm::dvec3(5, 6, 7));
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(0));
    EXPECT_EQ(scene.lights[1].direction, glm::dvec3(0, -1, 0));
    EXPECT_EQ(scene.animation.nodes.at(scene.lights[1].node).translation, glm::dvec3(0));
}

TEST(SceneTimeline, ASpinTurnsAboutItsCenterForEver)
{
    const Scene scene = parse(R"([{"at": 1, "object": "moon", "move": [0, 1, 0]}])", ".",
        R"(, {"name": "moon", "material": "m", "sphere": {"center": [4, 0, 0], "radius": 1},
             "spin": {"center": [1, 0, 0], "axis": [0, 2, 0], "period": 8}})");
    const Object& moon = scene.objects.back();
    ASSERT_EQ(scene.animation.nodes.size(), 2U);
    const Node& spin = scene.animation.nodes.at(moon.node);
    const Node& outer = scene.animation.nodes.at(spin.parent);
    EXPECT_EQ(outer.parent, kNone);
    EXPECT_EQ(outer.translation + spin.translation, glm::dvec3(1, 0, 0));
    EXPECT_EQ(std::get<Sphere>(moon.shape).center, glm::dvec3(3, 0, 0));
    ASSERT_EQ(scene.animation.tracks.size(), 2U);
    const Track& track = scene.animation.tracks[0];
    EXPECT_EQ(track.index, moon.node);
    EXPECT_EQ(track.period, 8);
    EXPECT_THAT(track.times, ElementsAre(0, 2, 4, 6, 8));
    EXPECT_NEAR(track.values[4 + 1], std::sqrt(0.5), 1e-6);  // a quarter about y at 2 s
    EXPECT_NEAR(track.values[4 + 3], std::sqrt(0.5), 1e-6);
}

TEST(SceneTimeline, AFileMovesAsAWhole)
{
    const TempFolder folder;
    GltfBuilder gltf = triangle_gltf();
    gltf.document["nodes"][0]["translation"] = {0, 0, 5};
    gltf.write_glb(folder.path() / "part.glb");
    const Scene scene = parse(R"([{"at": 0, "over": 1, "object": "part", "move": [1, 0, 0]}])",
        folder.path(),
        R"(, {"name": "part", "material": "m", "mesh": {"file": "part.glb", "translation": [3, 0, 0]}})");
    const Object& part = scene.objects.back();
    EXPECT_EQ(part.name, "part");
    EXPECT_EQ(scene.animation.nodes.at(part.node).translation, glm::dvec3(3, 0, 0));
    EXPECT_EQ(std::get<MeshInstance>(part.shape).world_from_object[3], glm::dvec4(0, 0, 5, 1));
}

}  // namespace
}  // namespace farlight
