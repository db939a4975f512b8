// Vertex attributes besides positions: texture coordinates, colours, tangents.
#include "lab/temp_folder.h"
#include "server/scene/pack_geometry.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/png.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using Json = nlohmann::json;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;

/// A unit square in z = 0, which shows a picture as it is: v = 1 - y.
const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<float> kSquareUvs{0, 1, 1, 1, 1, 0, 0, 0};
const std::vector<float> kUp{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};

class GltfVertexTest : public testing::Test {
protected:
    GltfVertexTest()
    {
        attributes_ = {{"POSITION", gltf_.add<float>(kSquare, "VEC3")}};
        indices_ = gltf_.add<std::uint8_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    }

    void add_normal_map(int uv_set = 0)
    {
        const int view = gltf_.add_view(png8(1, 1, {128, 128, 255, 255}));
        gltf_.document["images"] = {{{"bufferView", view}}};
        gltf_.document["textures"] = {{{"source", 0}}};
        gltf_.document["materials"] = {{{"normalTexture", {{"index", 0}, {"texCoord", uv_set}}}}};
    }

    Scene load()
    {
        Json primitive{{"attributes", attributes_}, {"indices", indices_}};
        if (gltf_.document.contains("materials"))
            primitive["material"] = 0;
        gltf_.add_mesh(primitive);
        gltf_.write_glb(folder_.path() / "test.glb");
        return load_scene(folder_.path() / "test.glb");
    }

    GltfBuilder gltf_;
    Json attributes_;
    int indices_ = 0;
    TempFolder folder_;
};

TEST_F(GltfVertexTest, TwoSetsOfTextureCoordinates)
{
    attributes_["TEXCOORD_0"] = gltf_.add<float>(kSquareUvs, "VEC2");
    attributes_["TEXCOORD_1"] =
        gltf_.add<std::uint16_t>({0, 65535, 65535, 65535, 65535, 0, 0, 0}, "VEC2", 0, true);
    const Scene scene = load();
    for (const auto& uvs : scene.meshes.at(0).uvs)
        EXPECT_THAT(
            uvs, ElementsAre(glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)));
}

TEST_F(GltfVertexTest, ColoursOfAllTypes)
{
    const std::vector<float> three{0, 0.5, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    attributes_["COLOR_0"] = gltf_.add<float>(three, "VEC3");
    EXPECT_EQ(load().meshes.at(0).colors.at(0), glm::vec4(0, 0.5F, 1, 1));
}

TEST_F(GltfVertexTest, ColoursOfBytesAndShorts)
{
    attributes_["COLOR_0"] = gltf_.add<std::uint8_t>(
        {255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255}, "VEC4", 0, true);
    EXPECT_EQ(load().meshes.at(0).colors.at(0), glm::vec4(1, 0, 0.2F, 0.4F));
    attributes_["COLOR_0"] =
        gltf_.add<std::uint16_t>({65535, 0, 13107, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", 8, true);
    EXPECT_EQ(load().meshes.at(1).colors.at(0), glm::vec4(1, 0, 0.2F, 1));
}

TEST_F(GltfVertexTest, BadNumbersAreRepairedAndCounted)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    attributes_["TEXCOORD_0"] = gltf_.add<float>({nan, 0, 1, 1, 1, 0, 0, 0}, "VEC2");
    attributes_["COLOR_0"] = gltf_.add<float>({nan, 0, 2, 1, 0, 0, 0, 1, 0, -1, 0, 1}, "VEC3");
    const Scene scene = load();
    EXPECT_EQ(scene.meshes.at(0).uvs[0].at(0), glm::vec2(0));
    EXPECT_EQ(scene.meshes[0].colors.at(0), glm::vec4(0, 0, 1, 1));
    EXPECT_THAT(scene.notes,
        testing::IsSupersetOf({"1 texture coordinate not finite: now 0, 0",
            "2 vertex colours outside [0, 1] clamped"}));
}

TEST_F(GltfVertexTest, GivenTangentsAreKept)
{
    attributes_["NORMAL"] = gltf_.add<float>(kUp, "VEC3");
    attributes_["TANGENT"] =
        gltf_.add<float>({0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1}, "VEC4");
    EXPECT_THAT(load().meshes.at(0).tangents, Each(glm::vec4(0, 1, 0, -1)));
}

TEST_F(GltfVertexTest, TangentsAreMadeForNormalMapsOnly)
{
    attributes_["NORMAL"] = gltf_.add<float>(kUp, "VEC3");
    attributes_["TEXCOORD_0"] = gltf_.add<float>(kSquareUvs, "VEC2");
    EXPECT_TRUE(load().meshes.at(0).tangents.empty());
    add_normal_map();
    const Scene scene = load();
    EXPECT_EQ(scene.meshes.at(1).positions.size(), 4U);
    EXPECT_THAT(scene.meshes[1].tangents, Each(glm::vec4(1, 0, 0, 1)));
}

TEST_F(GltfVertexTest, AMirroredPictureTurnsTheSign)
{
    attributes_["TEXCOORD_1"] = gltf_.add<float>({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2");
    add_normal_map(1);
    EXPECT_THAT(load().meshes.at(0).tangents, Each(glm::vec4(-1, 0, 0, -1)));
}

TEST_F(GltfVertexTest, VerticesBetweenBothSignsAreDoubled)
{
    // The second triangle runs back along u: its diagonal is shared in place and uv.
    attributes_["NORMAL"] = gltf_.add<float>(kUp, "VEC3");
    attributes_["TEXCOORD_0"] = gltf_.add<float>({0, 1, 1, 1, 1, 0, 1.5, 0.75}, "VEC2");
    add_normal_map();
    const Mesh mesh = load().meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), 6U);
    EXPECT_EQ(mesh.normals.size(), 6U);
    for (const int triangle : {0, 1})
        for (int corner = 0; corner < 3; ++corner)
            EXPECT_EQ(mesh.tangents[mesh.triangles[static_cast<std::size_t>(triangle)][corner]].w,
                triangle == 0 ? 1 : -1);
}

TEST_F(GltfVertexTest, BadTangentsAreMadeAnew)
{
    attributes_["NORMAL"] = gltf_.add<float>(kUp, "VEC3");
    attributes_["TEXCOORD_0"] = gltf_.add<float>(kSquareUvs, "VEC2");
    attributes_["TANGENT"] =
        gltf_.add<float>({0, 0, 0, 1, 0, 2, 0, -1, 0, 2, 0, -1, 0, 2, 0, -1}, "VEC4");
    add_normal_map();
    const Scene scene = load();
    EXPECT_THAT(scene.meshes.at(0).tangents, Each(glm::vec4(1, 0, 0, 1)));
    EXPECT_THAT(scene.notes,
        Contains("1 tangent without a direction: its mesh gets new ones where it needs any"));
}

TEST_F(GltfVertexTest, TangentsWhereUvSaysNothingAreStillUnit)
{
    attributes_["NORMAL"] = gltf_.add<float>(kUp, "VEC3");
    attributes_["TEXCOORD_0"] = gltf_.add<float>(std::vector<float>(8, 0.5F), "VEC2");
    add_normal_map();
    const Mesh mesh = load().meshes.at(0);
    ASSERT_EQ(mesh.tangents.size(), 4U);
    for (const glm::vec4& tangent : mesh.tangents) {
        EXPECT_NEAR(glm::length(glm::vec3(tangent)), 1, 1e-6);
        EXPECT_EQ(tangent.z, 0);
    }
}

TEST_F(GltfVertexTest, MirroredInstancesTurnTheSign)
{
    attributes_["NORMAL"] = gltf_.add<float>(kUp, "VEC3");
    attributes_["TEXCOORD_0"] = gltf_.add<float>(kSquareUvs, "VEC2");
    add_normal_map();
    load();
    const auto packed_signs = [&](int x_scale) {
        gltf_.document["nodes"][0]["scale"] = {x_scale, 1, 1};
        gltf_.write_glb(folder_.path() / "test.glb");
        const Scene scene = load_scene(folder_.path() / "test.glb");
        const FlatScene flat = flatten(scene);
        GeometryPacker packer(scene, flat, {.tangents = true});
        packer.pack(flat.groups[0], std::vector<std::uint32_t>{0, 1});
        const Texels& tangents = packer.packed().tangents;
        return std::vector<std::uint32_t>{tangents.at(0).w, tangents.at(1).w};
    };
    EXPECT_THAT(packed_signs(1), ElementsAre(0, 0));
    EXPECT_THAT(packed_signs(-1), ElementsAre(7, 7));  // each corner's bit: -1
}

}  // namespace
}  // namespace farlight
