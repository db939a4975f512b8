// KHR_lights_punctual and cameras.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>
#include <numbers>

namespace farlight {
namespace {

using Json = nlohmann::json;
using testing::Contains;

class GltfLightTest : public testing::Test {
protected:
    /// A node with light 0.
    GltfBuilder with_light(const Json& light, Json node = Json::object()) const
    {
        GltfBuilder gltf = triangle_gltf();
        gltf.document["extensionsUsed"] = {"KHR_lights_punctual"};
        gltf.document["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({light});
        node["extensions"]["KHR_lights_punctual"]["light"] = 0;
        gltf.document["nodes"].push_back(node);
        gltf.document["scenes"][0]["nodes"].push_back(1);
        return gltf;
    }

    Scene load(const GltfBuilder& gltf) const
    {
        gltf.write_glb(folder_.path() / "test.glb");
        return load_scene(folder_.path() / "test.glb");
    }

    TempFolder folder_;
};

constexpr float kHalf = 0.70710678F;  // sine and cosine of half a quarter turn

TEST_F(GltfLightTest, PointLights)
{
    const Scene scene = load(with_light({{"type", "point"}, {"color", {1, 0.5, 0}},
                                            {"intensity", 4}, {"name", "bulb"}, {"range", 3}},
        {{"translation", {1, 2, 3}}}));
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].kind, PunctualLight::Kind::kPoint);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(4, 2, 0));
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(1, 2, 3));
}

TEST_F(GltfLightTest, DirectionsFollowTheNode)
{
    // A quarter turn about x: -z becomes +y.
    const Scene scene =
        load(with_light({{"type", "directional"}}, {{"rotation", {kHalf, 0, 0, kHalf}}}));
    EXPECT_EQ(scene.lights.at(0).kind, PunctualLight::Kind::kDirectional);
    EXPECT_LE(glm::length(scene.lights[0].direction - glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(1));
}

TEST_F(GltfLightTest, SpotCones)
{
    Json light{{"type", "spot"}};
    EXPECT_EQ(load(with_light(light)).lights.at(0).inner_cone, 0);
    EXPECT_EQ(load(with_light(light)).lights.at(0).outer_cone, std::numbers::pi / 4);
    light["spot"] = {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}};
    EXPECT_EQ(load(with_light(light)).lights.at(0).inner_cone, 0.25);
    EXPECT_EQ(load(with_light(light)).lights.at(0).outer_cone, 0.5);
    light["spot"] = {{"innerConeAngle", 3}, {"outerConeAngle", 3}};
    const Scene scene = load(with_light(light));
    EXPECT_LT(scene.lights.at(0).inner_cone, scene.lights[0].outer_cone);
    EXPECT_EQ(scene.lights[0].outer_cone, std::numbers::pi / 2);
    EXPECT_THAT(scene.notes, Contains("1 lights with numbers outside their range clamped"));
}

TEST_F(GltfLightTest, ARangeIsNoted)
{
    EXPECT_THAT(load(with_light({{"type", "point"}, {"range", 0.5}})).notes,
        Contains("1 lights with a range: light has none here, it falls off with the square of the "
                 "distance"));
    EXPECT_THAT(load(with_light({{"type", "point"}})).notes,
        testing::Not(Contains(testing::HasSubstr("range"))));
}

TEST_F(GltfLightTest, BadLights)
{
    const auto refused = [&](const GltfBuilder& gltf) {
        return refusal((folder_.path() / "test.glb").string(), [&] { load(gltf); });
    };
    GltfBuilder gltf = with_light({{"type", "candle"}});
    EXPECT_EQ(refused(gltf),
        "/extensions/KHR_lights_punctual/lights/0/type: found \"candle\", expected one of point, "
        "spot, directional");
    gltf = with_light({{"type", "point"}});
    gltf.document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1;
    EXPECT_EQ(refused(gltf),
        "/nodes/1/extensions/KHR_lights_punctual/light: found index 1, expected less than 1, the "
        "number of lights");
    const Scene flat = load(with_light({{"type", "spot"}}, {{"scale", {0, 0, 0}}}));
    EXPECT_TRUE(flat.lights.empty());
    EXPECT_THAT(flat.notes, Contains("1 lights left out: a scale of 0 leaves no direction"));
}

TEST_F(GltfLightTest, APerspectiveCameraNeedsItsLens)
{
    GltfBuilder gltf = triangle_gltf();
    gltf.document["cameras"] = Json::array({{{"type", "perspective"}}});
    gltf.document["nodes"][0]["camera"] = 0;
    EXPECT_EQ(refusal((folder_.path() / "test.glb").string(), [&] { load(gltf); }),
        "/cameras/0: found no key \"perspective\", expected what its type says");
}

TEST_F(GltfLightTest, CamerasAfterTheFirstBecomePaths)
{
    GltfBuilder gltf = triangle_gltf();
    const Json lens{{"yfov", 1}, {"znear", 0.1}};
    gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", lens}},
        {{"type", "perspective"}, {"perspective", lens}, {"name", "side"}},
        {{"type", "orthographic"},
            {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}};
    for (int i = 0; i < 3; ++i) {
        gltf.document["nodes"].push_back({{"camera", i}, {"translation", {i, 0, 4}}});
        gltf.document["scenes"][0]["nodes"].push_back(i + 1);
    }
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.camera.position, glm::dvec3(0, 0, 4));
    ASSERT_EQ(scene.camera_paths.size(), 2U);
    ASSERT_EQ(scene.camera_paths.at("side").size(), 1U);
    EXPECT_EQ(scene.camera_paths.at("side")[0].pose.position, glm::dvec3(1, 0, 4));
    // At the triangle's distance it sees one metre up and down, as its ymag says.
    const CameraPose& flat = scene.camera_paths.at("camera 2")[0].pose;
    EXPECT_EQ(flat.target, glm::dvec3(2, 0, 0));
    EXPECT_NEAR(flat.position.z * std::tan(glm::radians(flat.vertical_fov_degrees / 2)), 1, 1e-12);
    EXPECT_THAT(scene.notes,
        Contains("1 orthographic cameras are perspective ones of 1 degree, seen from afar"));
}

/// The triangle, and cameras that an animation moves.
class GltfCameraPathTest : public GltfLightTest {
protected:
    GltfCameraPathTest() : gltf_(triangle_gltf())
    {
        gltf_.document["cameras"] = {{{"type", "perspective"},
            {"perspective", {{"yfov", 1}, {"znear", 0.1}}}, {"name", "crane"}}};
        gltf_.document["nodes"].push_back({{"children", {2}}, {"scale", {2, 2, 2}}});
        gltf_.document["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 3}}});
        gltf_.document["scenes"][0]["nodes"] = {0, 1};
    }

    void animate(int node, const char* path, const std::vector<float>& times,
        const std::vector<float>& values, const char* type)
    {
        const int input = gltf_.add<float>(times, "SCALAR");
        const int output = gltf_.add<float>(values, type);
        gltf_.document["animations"].push_back(
            {{"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
                {"samplers", {{{"input", input}, {"output", output}}}}});
    }

    /// Places and looks of the camera at 0, 1 and 2 s.
    void expect_turn(const std::vector<CameraKeyframe>& path)
    {
        const std::vector<glm::dvec3> positions{{0, 0, 6}, {6, 0, 0}, {6, 2, 0}};
        const std::vector<glm::dvec3> views{{0, 0, -1}, {-1, 0, 0}, {-1, 0, 0}};
        for (std::size_t second = 0; second < 3; ++second) {
            const CameraKeyframe& key = path.at(30 * second);
            EXPECT_EQ(key.frame, 30 * static_cast<double>(second));
            const glm::dvec3 view = glm::normalize(key.pose.target - key.pose.position);
            // Keys are floats: a quarter turn is one to 2^-24.
            EXPECT_LT(glm::length(key.pose.position - positions[second]), 1e-6) << second;
            EXPECT_LT(glm::length(view - views[second]), 1e-6) << second;
            EXPECT_LT(glm::length(key.pose.up - glm::dvec3(0, 1, 0)), 1e-6) << second;
        }
    }

    GltfBuilder gltf_;
};

TEST_F(GltfCameraPathTest, AMovingCameraIsAPath)
{
    animate(1, "rotation", {0, 1}, {0, 0, 0, 1, 0, kHalf, 0, kHalf}, "VEC4");  // above it
    animate(1, "translation", {1, 2}, {0, 0, 0, 0, 2, 0}, "VEC3");
    const Scene scene = load(gltf_);
    ASSERT_EQ(scene.camera_paths.size(), 1U);
    const auto& path = scene.camera_paths.at("crane");
    EXPECT_EQ(path.size(), 61U);
    EXPECT_EQ(scene.camera.position, path.front().pose.position) << "it starts where the path does";
    EXPECT_TRUE(scene.animation.empty()) << "nothing that is seen moves";
    EXPECT_THAT(scene.notes, testing::Not(Contains(testing::HasSubstr("camera"))));
}

TEST_F(GltfCameraPathTest, ItsKeyframesAreItsNodesTransforms)
{
    animate(1, "rotation", {0, 1, 2}, {0, 0, 0, 1, 0, kHalf, 0, kHalf, 0, kHalf, 0, kHalf}, "VEC4");
    animate(1, "translation", {1, 2}, {0, 0, 0, 0, 2, 0}, "VEC3");
    expect_turn(load(gltf_).camera_paths.at("crane"));
}

TEST_F(GltfCameraPathTest, LongPathsHaveFewerKeyframes)
{
    animate(2, "translation", {0, 1000}, {0, 0, 3, 1000, 0, 3}, "VEC3");
    const auto path = load(gltf_).camera_paths.at("crane");
    EXPECT_LE(path.size(), 4096U);
    EXPECT_EQ(path.back().frame, 30000);
    EXPECT_EQ(path.back().pose.position, glm::dvec3(2000, 0, 6));
    EXPECT_EQ(path.at(1).frame, 8);
}

TEST_F(GltfCameraPathTest, NamesAreUnique)
{
    gltf_.document["cameras"][0].erase("name");
    gltf_.document["nodes"].push_back({{"camera", 0}, {"name", "lookout"}});
    gltf_.document["nodes"].push_back({{"camera", 0}, {"name", "lookout"}});
    gltf_.document["scenes"][0]["nodes"] = {0, 1, 3, 4};
    animate(2, "translation", {0, 1}, {0, 0, 3, 1, 0, 3}, "VEC3");
    const Scene scene = load(gltf_);
    std::vector<std::string> names;
    for (const auto& path : scene.camera_paths)
        names.push_back(path.first);
    EXPECT_THAT(names, testing::ElementsAre("camera 0", "lookout", "lookout (node 4)"));
}

TEST_F(GltfCameraPathTest, WhatHasNoDirectionIsLeftOut)
{
    animate(2, "scale", {0, 1}, {0, 0, 0, 0, 0, 0}, "VEC3");
    const Scene scene = load(gltf_);
    EXPECT_TRUE(scene.camera_paths.empty());
    EXPECT_THAT(scene.notes,
        Contains("1 cameras left out: a scale of 0 leaves no direction, or they lie beyond 1e11"));
}

}  // namespace
}  // namespace farlight
