// Draco primitives and meshoptimizer buffer views: packed by their libraries, read back.
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/refusal.h"
#include "tests/scene/temp_folder.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gmock/gmock.h>
#include <meshoptimizer.h>

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

/// A square of two triangles in Draco's bytes: positions with id 0, texture coordinates with id 1.
std::string draco_square()
{
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int positions =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uvs = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const int faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int face = 0; face < 2; ++face) {
        const auto& [a, b, c] = faces[face];
        const draco::FaceIndex index(static_cast<std::uint32_t>(face));
        builder.SetAttributeValuesForFace(positions, index, corners[a], corners[b], corners[c]);
        builder.SetAttributeValuesForFace(uvs, index, corners[a], corners[b], corners[c]);
    }
    const auto mesh = builder.Finalize();
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(draco::Encoder().EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

GltfBuilder draco_gltf()
{
    GltfBuilder gltf;
    const int view = gltf.add_view(draco_square());
    gltf.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    gltf.document["accessors"] = {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}},
        {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}}};
    gltf.add_mesh({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"indices", 2},
        {"extensions",
            {{"KHR_draco_mesh_compression",
                {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}}}}}});
    return gltf;
}

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

/// A view of `values`, `stride` bytes each, packed; the fallback buffer 1 stands in for its bytes.
template <typename T, typename Encode>
int add_packed(GltfBuilder& gltf, const std::vector<T>& values, std::size_t stride,
    const char* mode, const char* filter, const Encode& encode)
{
    const std::string packed = encode(values);
    const int view = gltf.add_view(packed);
    Json& json = gltf.document["bufferViews"][static_cast<std::size_t>(view)];
    const std::size_t bytes = values.size() * sizeof(T);
    json["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
        {"byteOffset", json["byteOffset"]}, {"byteLength", packed.size()}, {"byteStride", stride},
        {"count", bytes / stride}, {"mode", mode}, {"filter", filter}};
    json["buffer"] = 1;
    json["byteOffset"] = 0;
    json["byteLength"] = bytes;
    return view;
}

template <typename T> auto vertex_encoder(std::size_t stride)
{
    return [stride](const std::vector<T>& values) {
        const std::size_t count = values.size() * sizeof(T) / stride;
        std::string packed(meshopt_encodeVertexBufferBound(count, stride), '\0');
        packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
            packed.size(), values.data(), count, stride));
        return packed;
    };
}

std::string encode_triangles(const std::vector<std::uint32_t>& corners)
{
    std::string packed(meshopt_encodeIndexBufferBound(corners.size(), 4), '\0');
    packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
        packed.size(), corners.data(), corners.size()));
    return packed;
}

std::string encode_sequence(const std::vector<std::uint32_t>& corners)
{
    std::string packed(meshopt_encodeIndexSequenceBound(corners.size(), 4), '\0');
    packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()),
        packed.size(), corners.data(), corners.size()));
    return packed;
}

const std::vector<std::uint32_t> kCorners{0, 1, 2, 0, 2, 3};

/// The same square, positions by the exponential filter, normals by the octahedral one.
GltfBuilder meshopt_gltf(bool as_sequence)
{
    GltfBuilder gltf;
    const std::vector<float> square{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    std::vector<std::uint32_t> coded(square.size());
    meshopt_encodeFilterExp(coded.data(), 4, 12, 15, square.data());
    const std::vector<float> normals{0, 0, 1, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0};
    std::vector<std::int8_t> octahedral(16);
    meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
    add_packed(gltf, coded, 12, "ATTRIBUTES", "EXPONENTIAL", vertex_encoder<std::uint32_t>(12));
    add_packed(gltf, octahedral, 4, "ATTRIBUTES", "OCTAHEDRAL", vertex_encoder<std::int8_t>(4));
    gltf.document["bufferViews"][1]["byteStride"] = 4;
    add_packed(gltf, kCorners, 4, as_sequence ? "INDICES" : "TRIANGLES", "NONE",
        as_sequence ? encode_sequence : encode_triangles);
    gltf.document["extensionsRequired"] = {"EXT_meshopt_compression"};
    gltf.document["buffers"].push_back({{"byteLength", 1000},
        {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    gltf.document["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5120}, {"count", 4}, {"type", "VEC3"},
            {"normalized", true}},
        {{"bufferView", 2}, {"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}};
    gltf.add_mesh({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}});
    return gltf;
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
