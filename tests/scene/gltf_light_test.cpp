// KHR_lights_punctual and cameras.
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/refusal.h"
#include "tests/scene/temp_folder.h"

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

const double kHalf = std::sqrt(0.5);

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
    ASSERT_EQ(scene.camera_paths.size(), 1U);
    ASSERT_EQ(scene.camera_paths.at("side").size(), 1U);
    EXPECT_EQ(scene.camera_paths.at("side")[0].pose.position, glm::dvec3(1, 0, 4));
    EXPECT_THAT(scene.notes, Contains("1 orthographic cameras left out"));
}

}  // namespace
}  // namespace farlight
