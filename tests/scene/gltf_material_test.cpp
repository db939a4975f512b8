// glTF materials, textures and images, read back.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/png.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using Json = nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kRedAndClear = png8(2, 1, {255, 0, 0, 255, 1, 2, 3, 0});

class GltfMaterialTest : public testing::Test {
protected:
    /// A triangle of the material, beside the document's own; image 0 is kRedAndClear, in the file.
    GltfBuilder with_material(const Json& material) const
    {
        GltfBuilder gltf = triangle_gltf();
        gltf.document["materials"] = Json::array({material});
        gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
        gltf.document["images"] = {{{"bufferView", gltf.add_view(kRedAndClear)}}};
        gltf.document["textures"] = {{{"source", 0}}};
        return gltf;
    }

    Scene load(const GltfBuilder& gltf) const
    {
        gltf.write_glb(folder_.path() / "test.glb");
        return load_scene(folder_.path() / "test.glb");
    }

    Material material(const Json& json) const { return load(with_material(json)).materials.at(0); }

    std::string refusal_of(const GltfBuilder& gltf) const
    {
        return refusal((folder_.path() / "test.glb").string(), [&] { load(gltf); });
    }

    TempFolder folder_;
};

TEST_F(GltfMaterialTest, AFilterThatIsNotReadIsNoted)
{
    const auto notes_with = [&](const Json& sampler) {
        GltfBuilder gltf =
            with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        gltf.document["samplers"] = Json::array({sampler});
        gltf.document["textures"][0]["sampler"] = 0;
        return load(gltf).notes;
    };
    const auto noted = Contains(
        "1 uses of textures with a minFilter of NEAREST smoothed where they shrink: only magFilter "
        "is read");
    for (const int nearest : {9728, 9984, 9986})
        EXPECT_THAT(notes_with({{"minFilter", nearest}}), noted) << nearest;
    for (const int linear : {9729, 9985, 9987})
        EXPECT_THAT(notes_with({{"minFilter", linear}}), testing::Not(noted)) << linear;
    EXPECT_THAT(notes_with({{"minFilter", 9984}, {"magFilter", 9728}}), testing::Not(noted));
}

TEST_F(GltfMaterialTest, DefaultsAreThoseOfGltf)
{
    const Material found = material({{"name", "plain"}});
    EXPECT_EQ(found.name, "plain");
    EXPECT_EQ(found.albedo, glm::vec3(1));
    EXPECT_EQ(found.metallic, 1);
    EXPECT_EQ(found.roughness, 1);
    EXPECT_EQ(found.specular, 1);
    EXPECT_EQ(found.ior, 1.5F);
    EXPECT_EQ(found.opacity, 1);
    EXPECT_EQ(found.alpha_cutoff, 0.5F);
    EXPECT_EQ(found.alpha_mode, AlphaMode::kOpaque);
    EXPECT_FALSE(found.emits_both_sides);
    EXPECT_FALSE(found.unlit);
    EXPECT_FALSE(found.albedo_texture.used());
}

TEST_F(GltfMaterialTest, CoreFactors)
{
    const Material found = material({{"doubleSided", true}, {"alphaMode", "MASK"},
        {"alphaCutoff", 0.25}, {"emissiveFactor", {1, 0.5, 0}},
        {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}},
        {"pbrMetallicRoughness",
            {{"baseColorFactor", {0.25, 0.5, 1, 0.75}}, {"metallicFactor", 0.125},
                {"roughnessFactor", 0.375}}}});
    EXPECT_TRUE(found.emits_both_sides);
    EXPECT_EQ(found.alpha_mode, AlphaMode::kMask);
    EXPECT_EQ(found.alpha_cutoff, 0.25F);
    EXPECT_EQ(found.emission, glm::vec3(8, 4, 0));
    EXPECT_EQ(found.albedo, glm::vec3(0.25F, 0.5F, 1));
    EXPECT_EQ(found.opacity, 0.75F);
    EXPECT_EQ(found.metallic, 0.125F);
    EXPECT_EQ(found.roughness, 0.375F);
    EXPECT_EQ(material({{"alphaMode", "BLEND"}}).alpha_mode, AlphaMode::kBlend);
}

TEST_F(GltfMaterialTest, ExtensionFactors)
{
    const Material found = material({{"extensions",
        {{"KHR_materials_ior", {{"ior", 1.75}}}, {"KHR_materials_unlit", Json::object()},
            {"KHR_materials_specular",
                {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0.5}}}},
            {"KHR_materials_clearcoat",
                {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.25}}}}}});
    EXPECT_EQ(found.ior, 1.75F);
    EXPECT_TRUE(found.unlit);
    EXPECT_EQ(found.specular, 0.5F);
    EXPECT_EQ(found.specular_color, glm::vec3(1, 2, 0.5F));
    EXPECT_EQ(found.clearcoat, 0.75F);
    EXPECT_EQ(found.clearcoat_roughness, 0.25F);
}

TEST_F(GltfMaterialTest, TransmissionIsThinUnlessItHasVolume)
{
    Json json = {{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}};
    EXPECT_EQ(material(json).transmission, 1);
    EXPECT_TRUE(material(json).thin_walled);

    Json& volume = json["extensions"]["KHR_materials_volume"];
    volume = {{"thicknessFactor", 0}, {"attenuationDistance", 2}, {"attenuationColor", {0, 0, 0}}};
    EXPECT_TRUE(material(json).thin_walled);
    EXPECT_EQ(material(json).absorption, glm::vec3(0));

    // exp(-sigma_a * 2 m) is the colour: 1, 1/e and nothing at all.
    volume = {{"thicknessFactor", 0.1}, {"attenuationDistance", 2},
        {"attenuationColor", {1, std::exp(-1.0), 0}}};
    EXPECT_FALSE(material(json).thin_walled);
    EXPECT_EQ(material(json).absorption.x, 0);
    EXPECT_NEAR(material(json).absorption.y, 0.5, 1e-6);  // a float's rounding
    EXPECT_GT(material(json).absorption.z, 5);
}

TEST_F(GltfMaterialTest, FactorsOutOfRangeAreClampedAndCounted)
{
    const Scene scene = load(with_material(
        {{"pbrMetallicRoughness", {{"baseColorFactor", {2, -1, 0.5, 1}}, {"roughnessFactor", 3}}},
            {"emissiveFactor", {0, 1e300, 0}},
            {"extensions", {{"KHR_materials_ior", {{"ior", 0.5}}}}}}));
    EXPECT_EQ(scene.materials[0].albedo, glm::vec3(1, 0, 0.5F));
    EXPECT_EQ(scene.materials[0].roughness, 1);
    EXPECT_EQ(scene.materials[0].ior, 1);
    EXPECT_EQ(scene.materials[0].emission.y, 1e18F);
    EXPECT_THAT(scene.notes, Contains("4 material factors outside their range clamped"));
}

TEST_F(GltfMaterialTest, EveryTextureLandsInItsPlace)
{
    const Json texture = {{"index", 0}};
    const auto used = [](const Material& m) {
        return std::vector<bool>{m.albedo_texture.used(), m.metallic_roughness_texture.used(),
            m.normal_texture.used(), m.emission_texture.used(), m.specular_texture.used(),
            m.specular_color_texture.used(), m.transmission_texture.used(),
            m.clearcoat_texture.used(), m.clearcoat_roughness_texture.used(),
            m.clearcoat_normal_texture.used()};
    };
    const std::vector<const char*> pointers{"/pbrMetallicRoughness/baseColorTexture",
        "/pbrMetallicRoughness/metallicRoughnessTexture", "/normalTexture", "/emissiveTexture",
        "/extensions/KHR_materials_specular/specularTexture",
        "/extensions/KHR_materials_specular/specularColorTexture",
        "/extensions/KHR_materials_transmission/transmissionTexture",
        "/extensions/KHR_materials_clearcoat/clearcoatTexture",
        "/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture",
        "/extensions/KHR_materials_clearcoat/clearcoatNormalTexture"};
    for (std::size_t i = 0; i < pointers.size(); ++i) {
        Json json = Json::object();
        json[Json::json_pointer(pointers[i])] = texture;
        std::vector<bool> expected(pointers.size(), false);
        expected[i] = true;
        EXPECT_EQ(used(material(json)), expected) << pointers[i];
    }
}

TEST_F(GltfMaterialTest, ACoatsNormalMapHasAScaleOfItsOwn)
{
    const Json textures = {{"normalTexture", {{"index", 0}, {"scale", 0.5}}},
        {"extensions",
            {{"KHR_materials_clearcoat",
                {{"clearcoatFactor", 1},
                    {"clearcoatNormalTexture", {{"index", 0}, {"scale", -3}}}}}}}};
    const Material coated = material(textures);
    EXPECT_EQ(coated.normal_scale, 0.5F);
    EXPECT_EQ(coated.clearcoat_normal_scale, -3);
}

TEST_F(GltfMaterialTest, SamplersUvSetsAndTransforms)
{
    GltfBuilder gltf = with_material({{"normalTexture", {{"index", 1}, {"scale", 0.5}}},
        {"pbrMetallicRoughness",
            {{"baseColorTexture",
                {{"index", 0}, {"texCoord", 1},
                    {"extensions",
                        {{"KHR_texture_transform",
                            {{"offset", {0.5, 0.25}}, {"rotation", std::acos(0.0)},
                                {"scale", {2, 4}}}}}}}}}}});
    gltf.document["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 0}}};
    gltf.document["samplers"] = {
        {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9987}}};
    const Scene scene = load(gltf);
    const Texture& base = scene.materials[0].albedo_texture;
    EXPECT_EQ(base.wrap_u, Wrap::kClamp);
    EXPECT_EQ(base.wrap_v, Wrap::kMirror);
    EXPECT_TRUE(base.nearest);
    EXPECT_EQ(base.uv_set, 1);
    // A quarter turn counter-clockwise as the picture is seen, v down: u goes up, v to the right.
    const glm::vec3 moved = base.image_from_uv * glm::vec3(0.5F, 0.25F, 1);
    EXPECT_NEAR(moved.x, 4 * 0.25 + 0.5, 1e-6);
    EXPECT_NEAR(moved.y, -2 * 0.5 + 0.25, 1e-6);
    const Texture& normal = scene.materials[0].normal_texture;
    EXPECT_EQ(normal, (Texture{.image = 0}));
    EXPECT_EQ(scene.materials[0].normal_scale, 0.5F);
    EXPECT_EQ(scene.images.size(), 1U);
}

TEST_F(GltfMaterialTest, AGlowingPictureIsNoLamp)
{
    const auto lamps = [&](const Json& json) {
        const Scene scene = load(with_material(json));
        return std::count_if(scene.objects.begin(), scene.objects.end(),
            [](const Object& object) { return object.name == "default light"; });
    };
    EXPECT_EQ(lamps({{"emissiveFactor", {1, 1, 1}}}), 0);
    EXPECT_EQ(lamps({{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}}), 1);
}

TEST_F(GltfMaterialTest, TheTransformsUvSetWins)
{
    const Material found = material({{"emissiveTexture",
        {{"index", 0}, {"texCoord", 0},
            {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}}}});
    EXPECT_EQ(found.emission_texture.uv_set, 1);
}

TEST_F(GltfMaterialTest, ImagesFromViewsFilesAndDataUrisAreDecodedOnce)
{
    GltfBuilder gltf = with_material({{"emissiveTexture", {{"index", 0}}},
        {"normalTexture", {{"index", 1}}},
        {"pbrMetallicRoughness",
            {{"baseColorTexture", {{"index", 2}}}, {"metallicRoughnessTexture", {{"index", 3}}}}}});
    const std::string deep = png16(1, 1, {0xffff, 0x8000, 0x00ff, 0x0100});
    folder_.write("a picture.png", kRedAndClear);
    gltf.document["images"].push_back({{"uri", "a%20picture.png"}});
    gltf.document["images"].push_back({{"uri", data_uri("image/png", kRedAndClear)}});
    gltf.document["images"].push_back({{"uri", data_uri("image/png", deep)}, {"name", "deep"}});
    gltf.document["textures"] = {
        {{"source", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 3}}};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.images.size(), 2U);
    const Material& found = scene.materials[0];
    EXPECT_EQ(found.emission_texture.image, found.normal_texture.image);
    EXPECT_EQ(found.emission_texture.image, found.albedo_texture.image);
    const Image8& image = scene.images[found.emission_texture.image];
    EXPECT_EQ(image.width, 2U);
    EXPECT_EQ(image.height, 1U);
    EXPECT_THAT(image.texels, ElementsAre(glm::u8vec4(255, 0, 0, 255), glm::u8vec4(1, 2, 3, 0)));
    const Image8& from16 = scene.images[found.metallic_roughness_texture.image];
    EXPECT_EQ(from16.name, "deep");
    EXPECT_THAT(from16.texels, ElementsAre(glm::u8vec4(255, 128, 0, 1)));
}

TEST_F(GltfMaterialTest, ImagesThatNoMaterialUsesAreNotRead)
{
    GltfBuilder gltf = with_material(Json::object());
    gltf.document["images"] = {{{"uri", "not there.png"}}};
    EXPECT_TRUE(load(gltf).images.empty());
}

TEST_F(GltfMaterialTest, BadImagesAreRefused)
{
    GltfBuilder gltf = with_material({{"emissiveTexture", {{"index", 0}}}});
    gltf.document["images"] = {{{"uri", "not there.png"}}};
    EXPECT_EQ(refusal_of(gltf),
        "/images/0/uri: found \"not there.png\", and no such file, expected a file of bytes");
    gltf.document["images"] = {{{"uri", data_uri("image/png", "no picture at all")}}};
    EXPECT_THAT(refusal_of(gltf), testing::StartsWith("/images/0: found "));
    gltf.document["images"] = {{{"uri", data_uri("image/png", kRedAndClear.substr(0, 50))}}};
    EXPECT_THAT(refusal_of(gltf), testing::StartsWith("/images/0: found a broken picture"));
    gltf.document["images"] = {{{"uri", "data:image/png;base64,!!!!"}}};
    EXPECT_EQ(refusal_of(gltf),
        "/images/0/uri: found \"data:image/png;base64,!!!!\", expected base64 after the comma");
    gltf.document["images"] = {{{"bufferView", 9}}};
    EXPECT_THAT(refusal_of(gltf), HasSubstr("/images/0/bufferView: found index 9"));
    gltf.document["images"] = Json::array({Json::object()});
    EXPECT_EQ(refusal_of(gltf), "/images/0: found no key \"uri\", expected a uri or a bufferView");
    gltf.document["textures"][0]["source"] = 1;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("/textures/0/source: found index 1"));
    gltf.document["textures"][0]["source"] = 0;
    gltf.document["materials"][0]["emissiveTexture"]["index"] = 1;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("/materials/0/emissiveTexture/index: found index 1"));
}

TEST_F(GltfMaterialTest, AHugePictureInFewBytesIsRefusedBeforeItIsMade)
{
    std::string huge = kRedAndClear;
    huge[18] = 0x40;  // width 2 + 16384
    huge[22] = 0x30;  // height 1 + 12288
    GltfBuilder gltf = with_material({{"emissiveTexture", {{"index", 0}}}});
    gltf.document["images"] = {{{"uri", data_uri("image/png", huge)}}};
    EXPECT_THAT(refusal_of(gltf), HasSubstr("found a picture of 16386 x 12289"));
    huge[18] = 0x30;
    gltf.document["images"] = {{{"uri", data_uri("image/png", huge)}}};
    EXPECT_THAT(refusal_of(gltf), HasSubstr("expected bytes for all of it"));
}

TEST_F(GltfMaterialTest, WhatOnlyAnExtensionPicturesIsNoted)
{
    GltfBuilder gltf = with_material(
        {{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}, {"normalTexture", {{"index", 1}}}});
    gltf.document["textures"].push_back(
        {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
    gltf.document["extensionsUsed"] = {"KHR_texture_basisu"};
    const Scene scene = load(gltf);
    EXPECT_FALSE(scene.materials[0].normal_texture.used());
    EXPECT_TRUE(scene.materials[0].emission_texture.used());
    EXPECT_THAT(scene.notes,
        testing::IsSupersetOf({"1 uses of textures without a PNG or JPEG image left out",
            "1 uses of textures read with UV set 0: only sets 0 and 1 are read",
            "extensions that are not read: KHR_texture_basisu"}));
}

TEST_F(GltfMaterialTest, AMeshWithoutTheCoordinatesOfItsTexturesIsNoted)
{
    const char* note = "1 objects with a textured material lack texture coordinates: they show the "
                       "texel at 0, 0";
    GltfBuilder gltf =
        with_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    EXPECT_THAT(load(gltf).notes, Contains(note));
    gltf.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
        gltf.add<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    EXPECT_THAT(load(gltf).notes, testing::Not(Contains(note)));
    gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
    EXPECT_THAT(load(gltf).notes, Contains(note));
    gltf.document["materials"] = {Json::object()};
    EXPECT_THAT(load(gltf).notes, testing::Not(Contains(note)));
}

}  // namespace
}  // namespace farlight
