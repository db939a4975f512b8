// glTF animations, skins and morph targets -> nodes, skins, tracks.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using Json = nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using Target = Track::Target;

class GltfAnimationTest : public testing::Test {
protected:
    GltfAnimationTest() : gltf_(triangle_gltf()) { gltf_.document["animations"] = Json::array(); }

    /// Adds a clip of one channel; values as many as `type` has, a key.
    void animate(int node, const char* path, const std::vector<float>& times,
        const std::vector<float>& values, const char* type, const char* interpolation = "LINEAR")
    {
        const int input = gltf_.add<float>(times, "SCALAR");
        const int output = gltf_.add<float>(values, type);
        gltf_.document["animations"].push_back(
            {{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
                {"samplers",
                    {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
    }

    Scene load() const
    {
        gltf_.write_glb(folder_.path() / "test.glb");
        return load_scene(folder_.path() / "test.glb");
    }

    std::string refused() const
    {
        return refusal((folder_.path() / "test.glb").string(), [&] { load(); });
    }

    GltfBuilder gltf_;
    TempFolder folder_;
};

TEST_F(GltfAnimationTest, ATrackForEachInterpolation)
{
    const std::vector<std::pair<const char*, Track::Interpolation>> rows{
        {"STEP", Track::Interpolation::kStep}, {"LINEAR", Track::Interpolation::kLinear},
        {"CUBICSPLINE", Track::Interpolation::kCubic}};
    for (const auto& [name, interpolation] : rows) {
        gltf_ = triangle_gltf();
        std::vector<float> values{0, 0, 0, 1, 2, 3};
        if (interpolation == Track::Interpolation::kCubic)
            values = {9, 9, 9, 0, 0, 0, 8, 8, 8, 7, 7, 7, 1, 2, 3, 6, 6, 6};
        animate(0, "translation", {0, 2}, values, "VEC3", name);
        const Scene scene = load();
        ASSERT_EQ(scene.animation.tracks.size(), 1U);
        const Track& track = scene.animation.tracks[0];
        EXPECT_EQ(track.target, Target::kTranslation);
        EXPECT_EQ(track.index, 0U);
        EXPECT_EQ(track.interpolation, interpolation);
        EXPECT_THAT(track.times, ElementsAre(0, 2));
        EXPECT_EQ(track.values, values);
        EXPECT_EQ(track.period, 2);
    }
}

TEST_F(GltfAnimationTest, RestingNodesAreFoldedIntoWhatCarriesThem)
{
    // 0 rests at x = 1; 1 below it moves; 2 below that rests at z = 5 with a mesh; 3 rests alone.
    gltf_.document["nodes"] = {{{"children", {1}}, {"translation", {1, 0, 0}}},
        {{"children", {2}}, {"translation", {0, 2, 0}}, {"name", "mover"}},
        {{"mesh", 0}, {"translation", {0, 0, 5}}}, {{"mesh", 0}, {"translation", {7, 0, 0}}}};
    gltf_.document["scenes"][0]["nodes"] = {0, 3};
    animate(1, "translation", {0, 1}, {0, 2, 0, 0, 3, 0}, "VEC3");
    const Scene scene = load();
    ASSERT_EQ(scene.animation.nodes.size(), 1U);
    const Node& node = scene.animation.nodes[0];
    EXPECT_EQ(node.name, "mover");
    EXPECT_EQ(node.parent, kNone);
    EXPECT_EQ(node.local[3], glm::dvec4(1, 0, 0, 1));
    EXPECT_EQ(node.translation, glm::dvec3(0, 2, 0));
    EXPECT_EQ(scene.objects.at(0).node, 0U);
    EXPECT_EQ(std::get<MeshInstance>(scene.objects[0].shape).world_from_object[3],
        glm::dvec4(0, 0, 5, 1));
    EXPECT_EQ(scene.objects.at(1).node, kNone);
    EXPECT_EQ(std::get<MeshInstance>(scene.objects[1].shape).world_from_object[3],
        glm::dvec4(7, 0, 0, 1));
}

TEST_F(GltfAnimationTest, WhatCarriesNothingIsLeftOut)
{
    gltf_.document["nodes"].push_back({{"name", "empty"}});
    gltf_.document["scenes"][0]["nodes"] = {0, 1};
    animate(1, "scale", {0, 1}, {1, 1, 1, 2, 2, 2}, "VEC3");
    const Scene scene = load();
    EXPECT_TRUE(scene.animation.nodes.empty());
    EXPECT_TRUE(scene.animation.tracks.empty());
    EXPECT_EQ(scene.objects.at(0).node, kNone);
}

TEST_F(GltfAnimationTest, ParentsComeFirst)
{
    gltf_.document["nodes"] = {{{"mesh", 0}}, {{"children", {0}}}};
    gltf_.document["scenes"][0]["nodes"] = {1};
    animate(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3");
    animate(1, "translation", {0, 3}, {0, 0, 0, 0, 1, 0}, "VEC3");
    const Scene scene = load();
    ASSERT_EQ(scene.animation.nodes.size(), 2U);
    EXPECT_EQ(scene.animation.nodes[1].parent, 0U);
    ASSERT_EQ(scene.animation.tracks.size(), 2U);
    EXPECT_EQ(scene.animation.tracks[0].index, 1U);
    EXPECT_EQ(scene.animation.tracks[0].period, 1);
    EXPECT_EQ(scene.animation.tracks[1].index, 0U);
    EXPECT_EQ(scene.animation.tracks[1].period, 3);
}

TEST_F(GltfAnimationTest, LightsAreCarried)
{
    gltf_.document["nodes"].push_back(
        {{"translation", {4, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf_.document["scenes"][0]["nodes"] = {0, 1};
    gltf_.document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    animate(1, "translation", {0, 1}, {4, 0, 0, 5, 0, 0}, "VEC3");
    const Scene scene = load();
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].node, 0U);
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(0));
    EXPECT_EQ(scene.animation.nodes.at(0).translation, glm::dvec3(4, 0, 0));
}

TEST_F(GltfAnimationTest, TheFirstClipThatDrivesSomethingWins)
{
    animate(0, "translation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3");
    animate(0, "translation", {0, 1}, {0, 0, 0, 2, 0, 0}, "VEC3");
    const Scene scene = load();
    ASSERT_EQ(scene.animation.tracks.size(), 1U);
    EXPECT_EQ(scene.animation.tracks[0].values[3], 1);
    EXPECT_THAT(
        scene.notes, Contains("1 animation channels left out: an earlier clip drives the same"));
}

TEST_F(GltfAnimationTest, RepairsAreCounted)
{
    gltf_.document["nodes"][0]["rotation"] = {0, 0, 0, 2};
    animate(0, "rotation", {0, 1, 1}, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 3, 0}, "VEC4");
    const Scene scene = load();
    EXPECT_THAT(scene.animation.tracks.at(0).times, ElementsAre(0, 1));
    EXPECT_THAT(scene.animation.tracks[0].values, ElementsAre(0, 0, 0, 1, 0, 0, 1, 0));
    EXPECT_EQ(scene.animation.nodes.at(0).rotation, glm::dquat(1, 0, 0, 0));
    EXPECT_THAT(scene.notes,
        testing::IsSupersetOf({"1 keyframes at the time of the next left out",
            "1 keyframes' rotations that were no unit quaternions brought to length 1",
            "1 nodes' rotations that were no unit quaternions brought to length 1"}));
}

TEST_F(GltfAnimationTest, BadSamplersAreRefused)
{
    const auto refused_for = [&](const char* path, const std::vector<float>& times,
                                 const std::vector<float>& values, const char* type) {
        gltf_ = triangle_gltf();
        animate(0, path, times, values, type);
        return refused();
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refused_for("translation", {1, 0}, {0, 0, 0, 1, 0, 0}, "VEC3"),
        "/animations/0/samplers/0/input: found times that do not increase, expected increasing "
        "times");
    EXPECT_THAT(refused_for("translation", {nan, 1}, {0, 0, 0, 1, 0, 0}, "VEC3"),
        HasSubstr("/animations/0/samplers/0/input: found the time"));
    EXPECT_THAT(refused_for("translation", {0, 1}, {0, 0, nan, 1, 0, 0}, "VEC3"),
        HasSubstr("/animations/0/samplers/0/output: found a number that is not finite"));
    EXPECT_EQ(refused_for("translation", {0, 1}, {0, 0, 0}, "VEC3"),
        "/animations/0/samplers/0/output: found 3 numbers, expected 6, a value a key");
    EXPECT_THAT(refused_for("rotation", {0, 1}, {0, 0, 0, 1, 0, 0}, "VEC3"),
        HasSubstr("found VEC3 of component type 5126, expected VEC4"));
    EXPECT_THAT(refused_for("rotation", {0}, {0, 0, 0, 0}, "VEC4"),
        HasSubstr("found a quaternion of no length"));
}

TEST_F(GltfAnimationTest, BadChannelsAreRefused)
{
    animate(0, "translation", {0}, {0, 0, 0}, "VEC3");
    const GltfBuilder good = gltf_;
    const auto refused_with = [&](const char* place, const Json& value) {
        gltf_ = good;
        gltf_.document[Json::json_pointer(std::string("/animations/0/") + place)] = value;
        return refused();
    };
    EXPECT_EQ(refused_with("channels/0/target/node", 3),
        "/animations/0/channels/0/target/node: found index 3, expected less than 1, the number "
        "of nodes");
    EXPECT_EQ(refused_with("channels/0/sampler", 1),
        "/animations/0/channels/0/sampler: found index 1, expected less than 1, the number of "
        "samplers");
    EXPECT_THAT(refused_with("samplers/0/input", 99), HasSubstr("/input: found index 99"));
    EXPECT_THAT(refused_with("samplers/0/input", 0), HasSubstr("expected SCALAR of floats"));
    EXPECT_THAT(refused_with("samplers/0/interpolation", "FAST"),
        HasSubstr("expected one of LINEAR, STEP, CUBICSPLINE"));
    gltf_ = good;
    gltf_.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_THAT(refused(), HasSubstr("target/node: found a node with a matrix"));
}

/// One primitive with two morph targets, the second of which moves corner 1 by z = 1.
class GltfMorphTest : public GltfAnimationTest {
protected:
    GltfMorphTest()
    {
        const int moves = gltf_.add<float>({0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3");
        gltf_.document["accessors"].push_back(
            {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
        gltf_.document["meshes"][0]["primitives"][0]["targets"] = {
            {{"POSITION", moves + 1}}, {{"POSITION", moves}}};
        gltf_.document["meshes"][0]["weights"] = {0, 0.5};
    }
};

TEST_F(GltfMorphTest, TargetsAndWeights)
{
    animate(0, "weights", {0, 1}, {0, 0, 0, 1}, "SCALAR");
    const Scene scene = load();
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.morph_targets.size(), 2U);
    EXPECT_TRUE(mesh.morph_targets[0].positions.empty());
    EXPECT_EQ(mesh.morph_targets[1].positions.at(1), glm::vec3(0, 0, 1));
    EXPECT_THAT(
        std::get<MeshInstance>(scene.objects.at(0).shape).morph_weights, ElementsAre(0, 0.5F));
    ASSERT_EQ(scene.animation.tracks.size(), 1U);
    EXPECT_EQ(scene.animation.tracks[0].target, Target::kMorphWeights);
    EXPECT_EQ(scene.animation.tracks[0].index, 0U);
    EXPECT_THAT(scene.animation.tracks[0].values, ElementsAre(0, 0, 0, 1));
}

TEST_F(GltfMorphTest, TheNodesWeightsGoBeforeTheMeshs)
{
    gltf_.document["nodes"][0]["weights"] = {1, 0.25};
    const Scene scene = load();
    EXPECT_THAT(
        std::get<MeshInstance>(scene.objects.at(0).shape).morph_weights, ElementsAre(1, 0.25F));
}

TEST_F(GltfMorphTest, BadWeightsAreRefused)
{
    gltf_.document["nodes"][0]["weights"] = {1};
    EXPECT_EQ(refused(), "/nodes/0/weights: found 1 weights, expected 2, one a morph target");
    gltf_.document["nodes"][0].erase("weights");
    animate(0, "weights", {0, 1}, {0, 1}, "SCALAR");
    EXPECT_EQ(refused(),
        "/animations/0/samplers/0/output: found 1 weights a key, expected 2, one a morph target");
    gltf_.document["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] = 1;
    EXPECT_THAT(refused(), HasSubstr("/targets/0/POSITION: found SCALAR of component type 5123"));
}

TEST_F(GltfAnimationTest, OtherAttributesOfMorphTargetsAreNoted)
{
    gltf_.document["meshes"][0]["primitives"][0]["targets"] = {
        {{"POSITION", 0}, {"TANGENT", 0}, {"COLOR_0", 0}}, {{"NORMAL", 0}, {"TEXCOORD_0", 0}}};
    EXPECT_THAT(load().notes,
        Contains("3 attributes of morph targets left out: only positions and normals are morphed"));
}

/// The triangle on a skin of two joints, nodes 1 and 2.
class GltfSkinTest : public GltfAnimationTest {
protected:
    GltfSkinTest()
    {
        Json& attributes = gltf_.document["meshes"][0]["primitives"][0]["attributes"];
        attributes["JOINTS_0"] =
            gltf_.add<std::uint8_t>({0, 1, 9, 9, 1, 9, 9, 9, 0, 1, 9, 9}, "VEC4");
        attributes["WEIGHTS_0"] =
            gltf_.add<float>({0.5, 0.5, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
        std::vector<float> binds(32, 0);
        for (const std::size_t i : {0U, 5U, 10U, 15U, 16U, 21U, 26U, 31U})
            binds[i] = 1;
        binds[28] = -3;
        gltf_.document["skins"] = {
            {{"joints", {1, 2}}, {"inverseBindMatrices", gltf_.add<float>(binds, "MAT4")}}};
        gltf_.document["nodes"][0]["skin"] = 0;
        gltf_.document["nodes"].push_back({{"children", {2}}});
        gltf_.document["nodes"].push_back({{"translation", {3, 0, 0}}});
        gltf_.document["scenes"][0]["nodes"] = {0, 1};
    }
};

TEST_F(GltfSkinTest, JointsBecomeNodesAndWeightsAreRepaired)
{
    animate(2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0}, "VEC4");
    const Scene scene = load();
    const auto& instance = std::get<MeshInstance>(scene.objects.at(0).shape);
    EXPECT_EQ(instance.skin, 0U);
    EXPECT_EQ(scene.objects[0].node, kNone);
    ASSERT_EQ(scene.animation.nodes.size(), 2U);
    EXPECT_EQ(scene.animation.nodes[1].parent, 0U);
    ASSERT_EQ(scene.animation.skins.size(), 1U);
    EXPECT_THAT(scene.animation.skins[0].joints, ElementsAre(0, 1));
    EXPECT_EQ(scene.animation.skins[0].joint_from_mesh.at(1)[3], glm::dvec4(-3, 0, 0, 1));
    EXPECT_EQ(scene.animation.tracks.at(0).index, 1U);
    const Mesh& mesh = scene.meshes.at(instance.mesh);
    EXPECT_THAT(mesh.joints,
        ElementsAre(glm::u16vec4(0, 1, 0, 0), glm::u16vec4(1, 0, 0, 0), glm::u16vec4(0)));
    EXPECT_THAT(mesh.weights,
        ElementsAre(glm::vec4(0.5F, 0.5F, 0, 0), glm::vec4(1, 0, 0, 0), glm::vec4(1, 0, 0, 0)));
    EXPECT_THAT(
        scene.notes, Contains("1 vertex without joint weights: the first joint moves them"));
}

TEST_F(GltfSkinTest, OfEightJointsTheStrongestFourStay)
{
    Json& attributes = gltf_.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = gltf_.add<std::uint8_t>({1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
    attributes["WEIGHTS_1"] = gltf_.add<float>({3, 2, 0.25, 0.125, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    const Scene scene = load();
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.weights.at(0), glm::vec4(0.5F, 2 / 6.0F, 0.5F / 6, 0.5F / 6));
    EXPECT_THAT(
        scene.notes, Contains("1 vertex with more than four joints: the four strongest move them"));
}

TEST_F(GltfSkinTest, BadSkinsAreRefused)
{
    const GltfBuilder good = gltf_;
    const auto refused_with = [&](const char* place, const Json& value) {
        gltf_ = good;
        gltf_.document[Json::json_pointer(place)] = value;
        return refused();
    };
    EXPECT_EQ(refused_with("/nodes/0/skin", 1),
        "/nodes/0/skin: found index 1, expected less than 1, the number of skins");
    EXPECT_EQ(refused_with("/skins/0/joints/0", 9),
        "/skins/0/joints/0: found index 9, expected less than 3, the number of nodes");
    EXPECT_EQ(refused_with("/skins/0/joints", Json::array()),
        "/skins/0/joints: found no joints, expected at least one joint");
    EXPECT_EQ(refused_with("/scenes/0/nodes", {0}),
        "/skins/0/joints/0: found node 1, which is not in the scene, expected a node of the "
        "scene");
    EXPECT_EQ(refused_with("/skins/0/joints", {1}),
        "/nodes/0/skin: found a mesh with joint 1, expected joints less than 1, the skin's "
        "number of them");
    EXPECT_EQ(refused_with("/skins/0/joints", {1, 2, 1}),
        "/skins/0/inverseBindMatrices: found 2 matrices, expected 3, one a joint");
    EXPECT_THAT(refused_with("/skins/0/inverseBindMatrices", 0),
        HasSubstr("found VEC3 of component type 5126, expected MAT4 of floats"));
    gltf_ = good;
    gltf_.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    EXPECT_EQ(refused(),
        "/nodes/0/skin: found a skin on a mesh without JOINTS_0 and WEIGHTS_0, expected both, or "
        "no skin");
}

}  // namespace
}  // namespace farlight
