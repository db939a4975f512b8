// glTF files written here, read back: component types, strides, topologies, transforms, materials.
#include "lab/temp_folder.h"
#include "server/scene/flatten.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/positions.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace farlight {
namespace {

/// Objects of the file itself: a default lamp is not framed.
std::size_t models_in(const Scene& scene)
{
    return static_cast<std::size_t>(std::count_if(scene.objects.begin(), scene.objects.end(),
        [](const auto& object) { return object.framed; }));
}

using Json = nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

class GltfTest : public testing::Test {
protected:
    Scene load(const GltfBuilder& gltf) const
    {
        gltf.write_glb(folder_.path() / "test.glb");
        return load_scene(folder_.path() / "test.glb");
    }

    TempFolder folder_;
};

const Mesh& only_mesh(const Scene& scene)
{
    EXPECT_EQ(scene.meshes.size(), 1U);
    return scene.meshes.at(0);
}

const std::vector<float> kTriangle{0, 0, 0, 1, 0, 0, 0, 1, 0};

template <typename T> class GltfIndexTest : public GltfTest {
};
using IndexTypes = testing::Types<std::uint8_t, std::uint16_t, std::uint32_t>;
TYPED_TEST_SUITE(GltfIndexTest, IndexTypes);

TYPED_TEST(GltfIndexTest, EveryTypeOfIndexIsRead)
{
    GltfBuilder gltf;
    const int positions = gltf.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
    const int indices = gltf.add<TypeParam>({0, 1, 2, 3, 2, 1}, "SCALAR");
    gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    EXPECT_THAT(only_mesh(this->load(gltf)).triangles,
        ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(3, 2, 1)));
}

template <typename T> class GltfPositionTest : public GltfTest {
};
using PositionTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t>;
TYPED_TEST_SUITE(GltfPositionTest, PositionTypes);

TYPED_TEST(GltfPositionTest, QuantizedPositionsAreReadWhateverTheStride)
{
    constexpr TypeParam kMost = std::numeric_limits<TypeParam>::max();
    for (const bool normalized : {false, true}) {
        GltfBuilder gltf;
        gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
        const int positions = gltf.add<TypeParam>(
            {0, 0, 0, kMost, 0, 0, 0, kMost, 0}, "VEC3", 4 * sizeof(TypeParam), normalized);
        gltf.add_mesh({{"attributes", {{"POSITION", positions}}}});
        const float one = normalized ? 1 : kMost;
        EXPECT_THAT(only_mesh(this->load(gltf)).positions,
            ElementsAre(glm::vec3(0), glm::vec3(one, 0, 0), glm::vec3(0, one, 0)));
    }
}

TEST_F(GltfTest, TheMostNegativeNormalizedIntegerIsMinusOneToo)
{
    GltfBuilder gltf;
    gltf.document["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int positions = gltf.add<std::int8_t>({0, 0, 0, -128, 0, 0, 0, -127, 0}, "VEC3", 4, true);
    gltf.add_mesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_THAT(only_mesh(load(gltf)).positions,
        ElementsAre(glm::vec3(0), glm::vec3(-1, 0, 0), glm::vec3(0, -1, 0)));
}

TEST_F(GltfTest, StridesOffsetsAndNormals)
{
    GltfBuilder gltf;
    const int positions = gltf.add<float>(kTriangle, "VEC3", 24);
    const int normals = gltf.add<float>({0, 0, 1, 0, 0, 2, 0, 0, 0.5}, "VEC3", 16);
    gltf.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    const Scene scene = load(gltf);
    EXPECT_THAT(only_mesh(scene).positions,
        ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(only_mesh(scene).normals, testing::Each(glm::vec3(0, 0, 1)));
    EXPECT_THAT(only_mesh(scene).triangles, ElementsAre(glm::uvec3(0, 1, 2)));
}

TEST_F(GltfTest, TwoAccessorsInOneInterleavedView)
{
    GltfBuilder gltf;
    gltf.add<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}, "VEC3");
    gltf.document["bufferViews"][0]["byteStride"] = 24;
    gltf.document["accessors"][0]["count"] = 3;
    gltf.document["accessors"].push_back({{"bufferView", 0}, {"byteOffset", 12}, {"count", 3},
        {"componentType", 5126}, {"type", "VEC3"}});
    gltf.add_mesh({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
    const Scene scene = load(gltf);
    EXPECT_EQ(only_mesh(scene).positions.at(2), glm::vec3(0, 1, 0));
    EXPECT_THAT(only_mesh(scene).normals, testing::Each(glm::vec3(0, 0, 1)));
}

TEST_F(GltfTest, StripsAndFansKeepTheirWinding)
{
    const std::vector<float> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    for (const auto& [mode, second] :
        {std::pair(5, glm::uvec3(1, 3, 2)), std::pair(6, glm::uvec3(0, 2, 3))}) {
        GltfBuilder gltf;
        const int positions = gltf.add<float>(corners, "VEC3");
        gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
        EXPECT_THAT(only_mesh(load(gltf)).triangles, ElementsAre(glm::uvec3(0, 1, 2), second))
            << "mode " << mode;
    }
}

TEST_F(GltfTest, SparseAccessorsReplaceElements)
{
    GltfBuilder gltf;
    const int positions = gltf.add<float>(kTriangle, "VEC3");
    gltf.add<std::uint16_t>({2}, "SCALAR");
    gltf.add<float>({0, 5, 0}, "VEC3");
    gltf.document["accessors"][0]["sparse"] = {{"count", 1},
        {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 2}}}};
    gltf.add_mesh({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(only_mesh(load(gltf)).positions.at(2), glm::vec3(0, 5, 0));
}

TEST_F(GltfTest, TransformsMultiplyDownTheTree)
{
    GltfBuilder gltf = triangle_gltf();
    // z by 90 degrees: (x, y) -> (-y, x).
    const double half = std::sqrt(0.5);
    gltf.document["nodes"] = {{{"children", {1, 2}}, {"translation", {10, 0, 0}}},
        {{"mesh", 0}, {"translation", {0, 0, 1}}, {"rotation", {0, 0, 2 * half, 2 * half}},
            {"scale", {2, 3, 4}}},
        {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}}};
    gltf.document["scenes"][0]["nodes"] = {0};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.meshes.size(), 1U);  // shared by both
    ASSERT_EQ(models_in(scene), 2U);
    expect_near(world_position(scene, 0, 1), {10, 2, 1});
    expect_near(world_position(scene, 0, 2), {7, 0, 1});
    expect_near(world_position(scene, 1, 1), {18, 8, 9});
}

TEST_F(GltfTest, MirroredInstancesStayCounterClockwise)
{
    GltfBuilder gltf = triangle_gltf();
    gltf.document["nodes"][0]["scale"] = {-1, 1, 1};
    gltf.document["nodes"].push_back({{"mesh", 0}});
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(gltf);
    ASSERT_EQ(models_in(scene), 2U);
    EXPECT_EQ(scene.meshes.size(), 1U);
    const FlatScene flat = flatten(scene);
    ASSERT_GE(flat.groups[0].triangles.size(), 2U);
    for (const FlatTriangle& triangle : flat.groups[0].triangles)
        if (triangle.object < 2) {
            const auto& [a, b, c] = triangle.vertices;
            EXPECT_GT(glm::cross(b - a, c - a).z, 0) << triangle.object;
        }
}

TEST_F(GltfTest, FlatInstancesAreLeftOut)
{
    GltfBuilder gltf = triangle_gltf();
    gltf.document["nodes"].push_back({{"mesh", 0}, {"scale", {1, 1, 0}}});
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(gltf);
    EXPECT_EQ(models_in(scene), 1U);
    EXPECT_THAT(scene.notes, Contains("1 objects left out: a scale of 0 makes them flat"));
}

TEST_F(GltfTest, WithoutCameraOrLightItGetsBoth)
{
    const Scene scene = load(triangle_gltf());
    EXPECT_EQ(scene.background, glm::vec3(0.2F));
    EXPECT_EQ(scene.objects.back().name, "default light");
    EXPECT_EQ(scene_bounds(scene).upper, glm::dvec3(1, 1, 0))
        << "the lamp is not part of what is framed";
    EXPECT_EQ(scene.camera.target, glm::dvec3(0.5, 0.5, 0));
    EXPECT_THAT(scene.notes,
        ElementsAre("primitives without a material are white rough metal, as glTF has it",
            "the file has no camera: one was placed that sees everything",
            HasSubstr("the file has no light: a soft one comes from all around")));
}

TEST_F(GltfTest, TheFirstPerspectiveCameraIsTaken)
{
    GltfBuilder gltf = triangle_gltf();
    gltf.document["cameras"] = {
        {{"type", "orthographic"},
            {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    gltf.document["nodes"].push_back({{"camera", 0}});
    gltf.document["nodes"].push_back({{"camera", 1}, {"translation", {0, 0, 4}}});
    gltf.document["scenes"][0]["nodes"] = {0, 1, 2};
    const CameraPose camera = load(gltf).camera;
    EXPECT_EQ(camera.position, glm::dvec3(0, 0, 4));
    expect_near(camera.target, {0, 0, 0});
    expect_near(camera.up, {0, 1, 0});
    EXPECT_NEAR(camera.vertical_fov_degrees, glm::degrees(1.0), 1e-12);
}

TEST_F(GltfTest, WhatIsNotReadIsNoted)
{
    GltfBuilder gltf = triangle_gltf();
    gltf.document["extensionsUsed"] = {"X_anything", "KHR_texture_transform"};
    gltf.document["extensions"] = {{"X_anything", "nonsense"}};
    EXPECT_THAT(load(gltf).notes, Contains("extensions that are not read: X_anything"));
}

/// Signed, positive where the faces look outward.
double volume(const Mesh& mesh)
{
    double volume = 0;
    for (const glm::uvec3& t : mesh.triangles)
        volume += glm::dot(glm::dvec3(mesh.positions[t.x]),
                      glm::cross(glm::dvec3(mesh.positions[t.y]), glm::dvec3(mesh.positions[t.z])))
            / 6;
    return volume;
}

TEST_F(GltfTest, PointsAndLinesAreThinSolids)
{
    const double diagonal = std::sqrt(2.0);  // of kTriangle
    const double radius = diagonal / 400;
    const double octahedron = 4.0 / 3 * radius * radius * radius;
    const double prism = 3 * std::sqrt(3.0) / 4 * radius * radius;  // a metre of it
    const std::vector<double> volumes{
        3 * octahedron, prism / 2, prism * (2 + diagonal), prism * (1 + diagonal)};
    // The second has one edge alone, a whole of 1 m: it is thinner by the square root of 2.
    for (const int mode : {0, 1, 2, 3}) {
        GltfBuilder gltf;
        const int positions = gltf.add<float>(kTriangle, "VEC3");
        Json primitive{{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
        if (mode == 1)
            primitive["indices"] = gltf.add<std::uint8_t>({0, 1}, "SCALAR");
        gltf.add_mesh(primitive);
        const Scene scene = load(gltf);
        const double expected = volumes[static_cast<std::size_t>(mode)];
        // Coordinates near 1 keep 24 bits, a radius of 1/280 thus 15, a volume of three 13.
        EXPECT_NEAR(volume(only_mesh(scene)) / expected, 1, 1e-3) << "mode " << mode;
        EXPECT_THAT(scene.notes, Contains("1 primitives of points or lines drawn as thin solids"));
    }
}

TEST_F(GltfTest, ALineToNoPositionIsRefused)
{
    GltfBuilder gltf;
    const int positions = gltf.add<float>(kTriangle, "VEC3");
    const int indices = gltf.add<std::uint8_t>({0, 3}, "SCALAR");
    gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"mode", 1}, {"indices", indices}});
    EXPECT_THROW(load(gltf), SceneError);
}

TEST_F(GltfTest, BadTrianglesAreDroppedAndCounted)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    GltfBuilder gltf;
    const int positions =
        gltf.add<float>({nan, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, inf, 0, 3, 0, 0}, "VEC3");
    const int indices =
        gltf.add<std::uint8_t>({0, 1, 2, 1, 2, 3, 1, 2, 4, 1, 2, 5, 1, 2, 6}, "SCALAR");
    gltf.add_mesh({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    const Scene scene = load(gltf);
    EXPECT_THAT(only_mesh(scene).triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_THAT(only_mesh(scene).positions,
        ElementsAre(glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
    EXPECT_THAT(scene.notes, Contains("1 triangle of zero area left out"));
    EXPECT_THAT(scene.notes, Contains("1 triangle with a corner that is no position left out"));
    EXPECT_THAT(scene.notes,
        Contains("2 triangles with a corner that is not finite (or beyond 1e11) left out"));
}

TEST_F(GltfTest, BuffersBesideTheFileAndInDataUris)
{
    for (const bool embedded : {false, true}) {
        const auto file = folder_.path() / (embedded ? "embedded.GLTF" : "with space.gltf");
        GltfBuilder gltf = triangle_gltf();
        gltf.bytes += "more than byteLength";
        gltf.write_gltf(file, embedded);
        if (!embedded) {
            Json document = gltf.document;
            document["buffers"][0]["uri"] = "with%20space.gltf.bin";
            folder_.write("with space.gltf", document.dump());
        } else {
            gltf.bytes.resize(gltf.document["buffers"][0]["byteLength"]);
            gltf.write_gltf(file, embedded);
        }
        EXPECT_EQ(only_mesh(load_scene(file)).triangles.size(), 1U);
    }
}

TEST_F(GltfTest, ADeepChainOfNodesDoesNotOverflowTheStack)
{
    constexpr int kDepth = 100000;
    GltfBuilder gltf = triangle_gltf();
    Json nodes = Json::array();
    for (int i = 0; i < kDepth; ++i)
        nodes.push_back({{"children", {i + 1}}});
    nodes.push_back({{"mesh", 0}});
    gltf.document["nodes"] = nodes;
    EXPECT_EQ(models_in(load(gltf)), 1U);
}

}  // namespace
}  // namespace farlight
