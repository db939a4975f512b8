// Draco primitives and meshoptimizer buffer views: packed by their libraries, read back.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/compressed_gltf.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class GltfCompressionTest : public testing::Test {
protected:
    Scene load(const GltfBuilder& gltf) const
    {
        gltf.write_glb(folder_.path() / "test.glb");
        return load_scene(folder_.path() / "test.glb");
    }

    std::string refusal_of(const GltfBuilder& gltf) const
    {
        return refusal((folder_.path() / "test.glb").string(), [&] { load(gltf); });
    }

    TempFolder folder_;
};

const Json::json_pointer kDraco("/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression");

TEST_F(GltfCompressionTest, DracoPrimitivesAreRead)
{
    const Scene scene = load(draco_gltf());
    const Mesh& mesh = scene.meshes.at(0);
    ASSERT_EQ(mesh.triangles.size(), 2U);
    ASSERT_EQ(mesh.positions.size(), 4U);
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles)
        area += 0.5
            * glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                mesh.positions[t.z] - mesh.positions[t.x])
                  .z;
    EXPECT_EQ(area, 1);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(mesh.uvs[0].at(i), glm::vec2(mesh.positions[i]));
}

TEST_F(GltfCompressionTest, DracoThatDoesNotFitItsAccessorsIsRefused)
{
    GltfBuilder gltf = draco_gltf();
    gltf.document["accessors"][0]["count"] = 5;
    gltf.document["accessors"][1]["count"] = 5;
    EXPECT_THAT(refusal_of(gltf),
        HasSubstr("found 4 compressed elements, expected 5, the accessor's count"));
    gltf = draco_gltf();
    gltf.document["accessors"][2]["count"] = 3;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("found 6 compressed corners, expected 3"));
    gltf = draco_gltf();
    gltf.document[kDraco]["attributes"]["TEXCOORD_0"] = 7;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("attributes/TEXCOORD_0: found 7, expected an id"));
    gltf = draco_gltf();
    gltf.document[kDraco]["attributes"]["TEXCOORD_0"] = 0;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("found 3 components, expected VEC2"));
    gltf = draco_gltf();
    gltf.document[kDraco]["bufferView"] = 1;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("bufferView: found index 1, expected less than 1"));
    gltf = draco_gltf();
    gltf.document["meshes"][0]["primitives"][0]["mode"] = 5;
    EXPECT_THAT(refusal_of(gltf), HasSubstr("/mode: found 5, expected 4"));
}

TEST_F(GltfCompressionTest, BrokenDracoIsRefused)
{
    GltfBuilder gltf = draco_gltf();
    for (const std::size_t length : {0U, 5U, 20U}) {
        gltf.document["bufferViews"][0]["byteLength"] = std::max<std::size_t>(1, length);
        EXPECT_THAT(refusal_of(gltf), HasSubstr("expected a Draco mesh")) << length;
    }
}

TEST_F(GltfCompressionTest, MeshoptViewsAreRead)
{
    for (const bool as_sequence : {false, true}) {
        const Scene scene = load(meshopt_gltf(as_sequence));
        const Mesh& mesh = scene.meshes.at(0);
        EXPECT_THAT(mesh.positions,
            testing::ElementsAre(
                glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(1, 1, 0), glm::vec3(0, 1, 0)));
        EXPECT_GT(mesh.normals.at(0).z, 0.999F);  // an 8-bit normal
        EXPECT_GT(mesh.normals.at(1).x, 0.999F);
        EXPECT_LT(mesh.normals.at(2).y, -0.999F);
        EXPECT_THAT(mesh.triangles, testing::ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)));
    }
}

struct BadMeshopt {
    const char* name;
    const char* place;  // within the extension of view 0
    const char* value;  // JSON
    const char* error;
};
void PrintTo(const BadMeshopt& bad, std::ostream* out)
{
    *out << bad.place << " = " << bad.value;
}

class BadMeshoptTest : public GltfCompressionTest,
                       public testing::WithParamInterface<BadMeshopt> { };

TEST_P(BadMeshoptTest, SaysWhereAndWhy)
{
    GltfBuilder gltf = meshopt_gltf(false);
    gltf.document[Json::json_pointer(std::string("/bufferViews/") + GetParam().place)] =
        Json::parse(GetParam().value);
    EXPECT_THAT(refusal_of(gltf), HasSubstr(GetParam().error));
}

INSTANTIATE_TEST_SUITE_P(Views, BadMeshoptTest,
    testing::Values(
        BadMeshopt{"Stride", "0/extensions/EXT_meshopt_compression/byteStride", "10",
            "byteStride: found 10, expected a stride that mode ATTRIBUTES with filter EXPONENTIAL"},
        BadMeshopt{"Filter", "0/extensions/EXT_meshopt_compression/filter", "\"QUATERNION\"",
            "byteStride: found 12, expected a stride that mode ATTRIBUTES with filter QUATERNION"},
        BadMeshopt{"Mode", "0/extensions/EXT_meshopt_compression/mode", "\"OTHER\"",
            "mode: found \"OTHER\", expected one of ATTRIBUTES, TRIANGLES, INDICES"},
        BadMeshopt{"Thirds", "2/extensions/EXT_meshopt_compression/count", "5",
            "count: found 5, expected a multiple of 3"},
        BadMeshopt{"HugeCount", "0/extensions/EXT_meshopt_compression/count", "4000000000",
            "count: found 4000000000 elements in "},
        BadMeshopt{"Length", "0/byteLength", "47",
            "byteLength: found 47, expected 48, what its compressed bytes hold"},
        BadMeshopt{"Range", "0/extensions/EXT_meshopt_compression/byteLength", "4000",
            "byteLength: found 4000, expected at most "},
        BadMeshopt{"Buffer", "0/extensions/EXT_meshopt_compression/buffer", "1",
            "buffer: found a buffer that stands in for compressed views, expected a buffer with "
            "bytes"},
        BadMeshopt{"PlainViewOfFallback", "0/extensions", "{}",
            "/bufferViews/0/buffer: found a buffer that stands in for compressed views"},
        BadMeshopt{"OtherBytes", "0/extensions/EXT_meshopt_compression/byteLength", "3",
            "expected a ATTRIBUTES stream of meshoptimizer"}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace farlight
