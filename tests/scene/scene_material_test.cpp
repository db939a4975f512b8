// Materials and textures of Farlight scenes.
#include "lab/temp_folder.h"
#include "server/scene/json_schema.h"
#include "server/scene/scene_file.h"
#include "tests/scene/png.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace farlight {
namespace {

using Json = nlohmann::json;

class SceneMaterialTest : public testing::Test {
protected:
    SceneMaterialTest() { folder_.write("a.png", png8(1, 2, {1, 2, 3, 4, 5, 6, 7, 8})); }

    Scene scene_with(const Json& materials) const
    {
        const Json document{{"version", 1}, {"materials", materials},
            {"objects",
                {{{"name", "ball"}, {"material", "m"},
                    {"sphere", {{"center", {0, 0, 0}}, {"radius", 1}}}}}}};
        return parse_scene(document.dump(), folder_.path(), "test.json");
    }
    Material read(const Json& material) const
    {
        return scene_with({{"m", material}}).materials.at(0);
    }
    Texture read_texture(Json texture) const
    {
        texture["file"] = "a.png";
        return read({{"albedo_texture", texture}}).albedo_texture;
    }

    TempFolder folder_;
};

/// A value that fits the schema's part and that no default has.
Json unusual(const std::string& key, const Json& part)
{
    if (part.contains("$ref"))
        return part["$ref"] == "#/definitions/texture" ? Json{{"file", "a.png"}}
            : part["$ref"] == "#/definitions/fraction" ? Json(0.25)
                                                       : Json{0.25, 0.5, 0.75};
    if (part.contains("enum"))
        return "mask";
    const std::string type = part.at("type").get<std::string>();
    return type == "boolean" ? Json(true)
        : type == "integer"  ? Json(3)
        : key == "ior"       ? Json(1.25)
                             : Json(0.25);
}

TEST_F(SceneMaterialTest, EveryKeyOfTheSchemaReachesTheMaterial)
{
    const Json schema = Json::parse(farlight_scene_schema());
    const Material plain = read(Json::object());
    std::vector<Material> seen{plain};
    for (const auto& [key, part] : schema["definitions"]["material"]["properties"].items()) {
        // A polish alone brings the dielectric's reflection with it: say it is none.
        Json value{{"specular", key == "specular" ? 0.25 : 0}};
        if (key == "opacity")
            value["alpha_mode"] = "opaque";
        value[key] = unusual(key, part);
        const Material material = read(value);
        EXPECT_THAT(seen, testing::Not(testing::Contains(material))) << key;
        seen.push_back(material);
    }
    EXPECT_EQ(seen.size(), 31U);  // 30 keys
}

TEST_F(SceneMaterialTest, NumbersArriveInTheirMembers)
{
    const Material m = read(Json::parse(R"({"albedo": [0.1, 0.2, 0.3], "emission": [4, 5, 6],
        "alpha_mode": "mask", "opacity": 0.7, "alpha_cutoff": 0.3, "metallic": 0.6,
        "roughness": 0.4, "normal_scale": -2, "ior": 1.33, "specular": 0.9,
        "specular_color": [0.5, 2, 0.25], "transmission": 0.8, "thin_walled": true,
        "absorption": [7, 8, 9], "priority": -4, "clearcoat": 0.65, "clearcoat_roughness": 0.05,
        "clearcoat_normal_scale": 3,
        "unlit": true})"));
    EXPECT_EQ(m.albedo, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(m.emission, glm::vec3(4, 5, 6));
    EXPECT_EQ(m.alpha_mode, AlphaMode::kMask);
    EXPECT_EQ(m.opacity, 0.7F);
    EXPECT_EQ(m.alpha_cutoff, 0.3F);
    EXPECT_EQ(m.metallic, 0.6F);
    EXPECT_EQ(m.roughness, 0.4F);
    EXPECT_EQ(m.normal_scale, -2);
    EXPECT_EQ(m.ior, 1.33F);
    EXPECT_EQ(m.specular, 0.9F);
    EXPECT_EQ(m.specular_color, glm::vec3(0.5F, 2, 0.25F));
    EXPECT_EQ(m.transmission, 0.8F);
    EXPECT_TRUE(m.thin_walled);
    EXPECT_EQ(m.absorption, glm::vec3(7, 8, 9));
    EXPECT_EQ(m.priority, -4);
    EXPECT_EQ(m.clearcoat, 0.65F);
    EXPECT_EQ(m.clearcoat_roughness, 0.05F);
    EXPECT_EQ(m.clearcoat_normal_scale, 3);
    EXPECT_TRUE(m.unlit);
}

TEST_F(SceneMaterialTest, DefaultsAreDull)
{
    EXPECT_EQ(read(Json::object()).specular, 0);
    EXPECT_EQ(read({{"metallic", 1}}).specular, 0);
    EXPECT_EQ(read({{"roughness", 0.5}}).specular, 1);
    EXPECT_EQ(read({{"transmission", 1}}).specular, 1);
    EXPECT_EQ(read({{"roughness", 0.5}, {"specular", 0}}).specular, 0);
    EXPECT_EQ(read(Json::object()).alpha_mode, AlphaMode::kOpaque);
    EXPECT_EQ(read({{"opacity", 0.5}}).alpha_mode, AlphaMode::kBlend);
    EXPECT_EQ(read({{"opacity", 0.5}, {"alpha_mode", "opaque"}}).alpha_mode, AlphaMode::kOpaque);
}

TEST_F(SceneMaterialTest, TexturesSayHowTheyAreLookedUp)
{
    const Texture plain = read_texture(Json::object());
    EXPECT_EQ(plain, (Texture{.image = 0}));
    EXPECT_EQ(read_texture({{"wrap", "mirror"}}).wrap_u, Wrap::kMirror);
    EXPECT_EQ(read_texture({{"wrap", "mirror"}}).wrap_v, Wrap::kMirror);
    const Texture two = read_texture({{"wrap", {"clamp", "repeat"}}});
    EXPECT_EQ(two.wrap_u, Wrap::kClamp);
    EXPECT_EQ(two.wrap_v, Wrap::kRepeat);
    EXPECT_TRUE(read_texture({{"nearest", true}}).nearest);
    EXPECT_EQ(read_texture({{"uv_set", 1}}).uv_set, 1);
}

TEST_F(SceneMaterialTest, TexturesAreScaledThenTurnedThenMoved)
{
    const glm::mat3 transform = read_texture(
        {{"scale", {2, 4}}, {"rotation_degrees", 90},
            {"offset", {10, 20}}}).image_from_uv;
    // (1, 0) becomes (2, 0); turned against the clock with v down (0, -2).
    const glm::vec3 u = transform * glm::vec3(1, 0, 1);
    EXPECT_NEAR(u.x, 10, 1e-5);
    EXPECT_NEAR(u.y, 18, 1e-5);
    const glm::vec3 v = transform * glm::vec3(0, 1, 1);
    EXPECT_NEAR(v.x, 14, 1e-5);
    EXPECT_NEAR(v.y, 20, 1e-5);
}

TEST_F(SceneMaterialTest, APictureIsReadOnceHoweverOftenItIsUsed)
{
    const Scene scene = scene_with({{"a", {{"albedo_texture", {{"file", "a.png"}}}}},
        {"m",
            {{"normal_texture", {{"file", "a.png"}}}, {"emission_texture", {{"file", "a.png"}}}}}});
    ASSERT_EQ(scene.images.size(), 1U);
    EXPECT_EQ(scene.images[0].name, "a.png");
    EXPECT_EQ(scene.images[0].width, 1U);
    EXPECT_EQ(scene.images[0].height, 2U);
    EXPECT_THAT(scene.images[0].texels,
        testing::ElementsAre(glm::u8vec4(1, 2, 3, 4), glm::u8vec4(5, 6, 7, 8)));
}

}  // namespace
}  // namespace farlight
