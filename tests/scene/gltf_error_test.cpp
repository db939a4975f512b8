// Malformed glTF: each table row breaks a good file in one place.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using Json = nlohmann::json;

struct BadGltf {
    const char* name;
    const char* place;  // JSON pointer to what is changed
    const char* value;  // JSON; empty removes it
    const char* error;
};
void PrintTo(const BadGltf& bad, std::ostream* out)
{
    *out << bad.place << " = " << bad.value;
}

class BadGltfTest : public testing::TestWithParam<BadGltf> { };

TEST_P(BadGltfTest, SaysWhereAndWhy)
{
    const BadGltf& bad = GetParam();
    GltfBuilder gltf = triangle_gltf();
    const Json::json_pointer place(bad.place);
    if (*bad.value == '\0')
        gltf.document[place.parent_pointer()].erase(place.back());
    else
        gltf.document[place] = Json::parse(bad.value);
    const TempFolder folder;
    const auto file = folder.path() / "bad.glb";
    gltf.write_glb(file);
    EXPECT_EQ(refusal(file.string(), [&] { load_scene(file); }), bad.error);
}

const auto kName = [](const auto& row) { return row.param.name; };

INSTANTIATE_TEST_SUITE_P(Document, BadGltfTest,
    testing::Values(BadGltf{"OldVersion", "/asset/version", "\"1.0\"",
                        "/asset/version: found \"1.0\", expected a glTF version 2.x"},
        BadGltf{"NewerNeeded", "/asset/minVersion", "\"2.1\"",
            "/asset/minVersion: found \"2.1\", expected 2.0, the newest glTF version that is "
            "read"},
        BadGltf{"NoAsset", "/asset", "",
            "found no key \"asset\", expected a glTF 2.0 object with asset, scenes, nodes, "
            "meshes, ..."},
        BadGltf{"Extensions", "/extensionsRequired", R"(["X_this", "KHR_materials_ior", "X_that"])",
            "/extensionsRequired: found X_this, X_that, expected none but extensions that Farlight "
            "reads: EXT_meshopt_compression, KHR_draco_mesh_compression, KHR_lights_punctual, "
            "KHR_materials_clearcoat, "
            "KHR_materials_emissive_strength, KHR_materials_ior, KHR_materials_specular, "
            "KHR_materials_transmission, KHR_materials_unlit, KHR_materials_volume, "
            "KHR_mesh_quantization, KHR_texture_transform"},
        BadGltf{"NoScenes", "/scenes", "", "/scenes: found no scene, expected at least one scene"},
        BadGltf{"WrongScene", "/scene", "1",
            "/scene: found index 1, expected less than 1, the number of scenes"},
        BadGltf{"SceneOfNothing", "/scenes/0/nodes", "[]",
            "/scenes: found no mesh in the scene's nodes, expected at least one"},
        BadGltf{"AllFlat", "/nodes/0/scale", "[0, 0, 0]",
            "/scenes/0/nodes: found 1 objects, all left out because their transform makes them "
            "flat, as a scale of 0 does, expected at least one that is not"},
        BadGltf{"WrongRoot", "/scenes/0/nodes", "[4]",
            "/scenes/0/nodes/0: found index 4, expected less than 1, the number of nodes"}),
    kName);

INSTANTIATE_TEST_SUITE_P(Bytes, BadGltfTest,
    testing::Values(
        BadGltf{"BufferLongerThanItsBytes", "/buffers/0/byteLength", "4000",
            "/buffers/0/byteLength: found 4000, expected at most the 44 bytes there are"},
        BadGltf{"BufferFileMissing", "/buffers/0/uri", "\"none.bin\"",
            "/buffers/0/uri: found \"none.bin\", and no such file, expected a file of bytes"},
        BadGltf{"BufferFromTheNet", "/buffers/0/uri", "\"http://example.com/a.bin\"",
            "/buffers/0/uri: found \"http://example.com/a.bin\", expected a data URI or a path "
            "relative to the file"},
        BadGltf{"BufferFromTheRoot", "/buffers/0/uri", "\"/dev/zero\"",
            "/buffers/0/uri: found \"/dev/zero\", expected a data URI or a path relative to the "
            "file"},
        BadGltf{"ViewOfNoBuffer", "/bufferViews/0/buffer", "1",
            "/bufferViews/0/buffer: found index 1, expected less than 1, the number of buffers"},
        BadGltf{"ViewBeyondBuffer", "/bufferViews/1/byteLength", "9",
            "/bufferViews/1/byteLength: found 9, expected at most 6, what the buffer still holds"},
        BadGltf{"ViewStartsBeyondBuffer", "/bufferViews/1/byteOffset", "42",
            "/bufferViews/1/byteOffset: found 42, expected less than 42, the buffer's byteLength"},
        BadGltf{"AccessorOfNoView", "/accessors/0/bufferView", "7",
            "/accessors/0/bufferView: found index 7, expected less than 2, the number of "
            "bufferViews"},
        BadGltf{"AccessorStartsBeyondView", "/accessors/0/byteOffset", "28",
            "/accessors/0/byteOffset: found 28, expected room for 12 bytes in a buffer view of "
            "36"},
        BadGltf{"AccessorBeyondView", "/accessors/0/count", "4",
            "/accessors/0/count: found 4, expected at most 3, what the buffer view holds"},
        BadGltf{"AccessorCountHuge", "/accessors/0/count", "4294967295",
            "/accessors/0/count: found 4294967295, expected at most 3, what the buffer view "
            "holds"},
        BadGltf{"AccessorCountNegative", "/accessors/0/count", "-1",
            "/accessors/0/count: found -1, expected an integer from 1 to 4294967295"},
        BadGltf{"ZerosWithoutEnd", "/accessors/0",
            R"({"count": 4294967295, "componentType": 5126, "type": "VEC3"})",
            "/accessors/0/count: found 4294967295, expected at most 65536 without a bufferView in "
            "a file of this size"},
        BadGltf{"StrideTooSmall", "/bufferViews/0/byteStride", "8",
            "/bufferViews/0/byteStride: found 8, expected at least 12, an element of "
            "/accessors/0"},
        BadGltf{"ComponentType", "/accessors/0/componentType", "5124",
            "/accessors/0/componentType: found 5124, expected a component type: 5120, 5121, "
            "5122, 5123, 5125 or 5126"},
        BadGltf{"SparseIndexBeyondAccessor", "/accessors/0/sparse",
            R"({"count": 2, "indices": {"bufferView": 0, "componentType": 5121, "byteOffset": 13},
                "values": {"bufferView": 0}})",
            "/accessors/0/sparse/indices: found index 128 as element 1, expected less than 3, the "
            "accessor's count"},
        BadGltf{"SparseIndexTwice", "/accessors/0/sparse",
            R"({"count": 2, "indices": {"bufferView": 0, "componentType": 5121},
                "values": {"bufferView": 0}})",
            "/accessors/0/sparse/indices: found index 0 as element 1 after 0, expected indices "
            "that strictly increase"},
        BadGltf{"SparseBeyondView", "/accessors/0/sparse",
            R"({"count": 2, "indices": {"bufferView": 1, "componentType": 5125},
                "values": {"bufferView": 0}})",
            "/accessors/0/sparse/indices/count: found 2, expected at most 1, what the buffer "
            "view holds"}),
    kName);

INSTANTIATE_TEST_SUITE_P(Meshes, BadGltfTest,
    testing::Values(BadGltf{"NoMeshes", "/meshes", "[]",
                        "/nodes/0/mesh: found index 0, expected less than 0, the number of meshes"},
        BadGltf{"NoPrimitives", "/meshes/0/primitives", "[]",
            "/meshes/0/primitives: found an empty array, expected an array of at least one "
            "primitive"},
        BadGltf{"NoPositions", "/meshes/0/primitives/0/attributes", "{}",
            "/meshes/0/primitives/0/attributes: found no key \"POSITION\", expected an accessor "
            "of positions"},
        BadGltf{"PositionsOfScalars", "/meshes/0/primitives/0/attributes/POSITION", "1",
            "/meshes/0/primitives/0/attributes/POSITION: found SCALAR of component type 5123, "
            "expected VEC3 of floats, or of bytes or shorts (KHR_mesh_quantization)"},
        BadGltf{"IndicesOfVectors", "/meshes/0/primitives/0/indices", "0",
            "/meshes/0/primitives/0/indices: found VEC3 of component type 5126, expected SCALAR "
            "of unsigned bytes, shorts or ints"},
        BadGltf{"NoSuchAccessor", "/meshes/0/primitives/0/indices", "2",
            "/meshes/0/primitives/0/indices: found index 2, expected less than 2, the number of "
            "accessors"},
        BadGltf{"NoSuchMaterial", "/meshes/0/primitives/0/material", "0",
            "/meshes/0/primitives/0/material: found index 0, expected less than 0, the number of "
            "materials"},
        BadGltf{"FewerNormals", "/accessors/2",
            R"({"bufferView": 0, "count": 2, "componentType": 5126, "type": "VEC3"})", "loaded"},
        BadGltf{"IndexBeyondPositions", "/accessors/0/count", "2",
            "/meshes/0/primitives/0: found no triangle that is left; 1 triangle with a corner that "
            "is no position left out, expected at least one triangle that has an area"},
        BadGltf{"TwoCorners", "/accessors/1/count", "2",
            "/meshes/0/primitives/0/indices: found 2 corners, expected at least one triangle"},
        BadGltf{"AllZeros", "/accessors/0",
            R"({"count": 3, "componentType": 5126, "type": "VEC3"})",
            "/meshes/0/primitives/0: found no triangle that is left; 1 triangle of zero area "
            "left out, expected at least one triangle that has an area"}),
    kName);

INSTANTIATE_TEST_SUITE_P(Nodes, BadGltfTest,
    testing::Values(BadGltf{"NoSuchMesh", "/nodes/0/mesh", "3",
                        "/nodes/0/mesh: found index 3, expected less than 1, the number of meshes"},
        BadGltf{"NoSuchChild", "/nodes/0/children", "[1]",
            "/nodes/0/children/0: found index 1, expected less than 1, the number of nodes"},
        BadGltf{"ItsOwnChild", "/nodes/0/children", "[0]",
            "/nodes/0/children/0: found node 0 a second time, expected a tree: no cycles, one "
            "parent a node"},
        BadGltf{"RootTwice", "/scenes/0/nodes", "[0, 0]",
            "/scenes/0/nodes/1: found node 0 a second time, expected a tree: no cycles, one "
            "parent a node"},
        BadGltf{"NegativeMesh", "/nodes/0/mesh", "-1",
            "/nodes/0/mesh: found -1, expected an index: an integer from 0"},
        BadGltf{"NoSuchCamera", "/nodes/0/camera", "0",
            "/nodes/0/camera: found index 0, expected less than 0, the number of cameras"},
        BadGltf{"ShortMatrix", "/nodes/0/matrix", "[1, 0, 0]",
            "/nodes/0/matrix: found [1,0,0], expected 16 numbers"},
        BadGltf{"Projective", "/nodes/0/matrix", "[1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]",
            "/nodes/0/matrix: found a projective transform, expected a last row of 0, 0, 0, 1"},
        BadGltf{"NoRotation", "/nodes/0/rotation", "[0, 0, 0, 0]",
            "/nodes/0/rotation: found a quaternion of no length, expected a unit quaternion"},
        BadGltf{"TooFar", "/nodes/0/translation", "[1e300, 0, 0]",
            "/nodes/0: found a transform beyond 1e11, expected numbers of at most 1e11 in "
            "magnitude"}),
    kName);

// Of what the scene shows none of.
INSTANTIATE_TEST_SUITE_P(Unused, BadGltfTest,
    testing::Values(BadGltf{"CycleOfNodes", "/nodes/1", R"({"children": [1]})",
                        "/nodes/1/children/0: found node 1 a second time, expected a tree: no "
                        "cycles, one parent a node"},
        BadGltf{"TwoParents", "/nodes",
            R"([{"mesh": 0}, {"children": [3]}, {"children": [3]}, {}])",
            "/nodes/2/children/0: found node 3 a second time, expected a tree: no cycles, one "
            "parent a node"},
        BadGltf{"Skin", "/skins", R"([{"joints": [0, 99]}])",
            "/skins/0/joints/1: found index 99, expected less than 1, the number of nodes"},
        BadGltf{"SkinWithoutJoints", "/skins", R"([{"joints": []}])",
            "/skins/0/joints: found no joints, expected at least one joint"},
        BadGltf{"Skeleton", "/skins", R"([{"joints": [0], "skeleton": 1}])",
            "/skins/0/skeleton: found index 1, expected less than 1, the number of nodes"},
        BadGltf{"BindMatrices", "/skins", R"([{"joints": [0], "inverseBindMatrices": 2}])",
            "/skins/0/inverseBindMatrices: found index 2, expected less than 2, the number of "
            "accessors"},
        BadGltf{"ImageOfTexture", "/textures", R"([{"source": 0}])",
            "/textures/0/source: found index 0, expected less than 0, the number of images"},
        BadGltf{"SamplerOfTexture", "/textures", R"([{"sampler": 0}])",
            "/textures/0/sampler: found index 0, expected less than 0, the number of samplers"},
        BadGltf{"ViewOfImage", "/images", R"([{"bufferView": 2}])",
            "/images/0/bufferView: found index 2, expected less than 2, the number of "
            "bufferViews"},
        BadGltf{"Lens", "/cameras", R"([{"type": "perspective"}])",
            "/cameras/0: found no key \"perspective\", expected what its type says"},
        BadGltf{"Channel", "/animations",
            R"([{"samplers": [], "channels": [{"sampler": 0, "target": {"path": "other"}}]}])",
            "/animations/0/channels/0/sampler: found index 0, expected less than 0, the number of "
            "samplers"},
        BadGltf{"NodeOfChannel", "/animations",
            R"([{"samplers": [{"input": 0, "output": 0}],
                 "channels": [{"sampler": 0, "target": {"node": 1, "path": "other"}}]}])",
            "/animations/0/channels/0/target/node: found index 1, expected less than 1, the number "
            "of nodes"},
        BadGltf{"Keyframes", "/animations",
            R"([{"samplers": [{"input": 0, "output": 2}], "channels": []}])",
            "/animations/0/samplers/0/output: found index 2, expected less than 2, the number of "
            "accessors"},
        BadGltf{"Attribute", "/meshes/0/primitives/0/attributes/TEXCOORD_5", "99",
            "/meshes/0/primitives/0/attributes/TEXCOORD_5: found index 99, expected less than 2, "
            "the number of accessors"},
        BadGltf{"MorphTarget", "/meshes/0/primitives/0/targets", R"([{"COLOR_0": 99}])",
            "/meshes/0/primitives/0/targets/0/COLOR_0: found index 99, expected less than 2, the "
            "number of accessors"},
        BadGltf{"Light", "/nodes/1", R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})",
            "/nodes/1/extensions/KHR_lights_punctual/light: found index 0, expected less than 0, "
            "the number of lights"}),
    kName);

class GltfContainerTest : public testing::Test {
protected:
    std::string refusal_of(const std::string& name, std::string_view bytes)
    {
        const auto file = folder_.write(name, bytes);
        return refusal(file.string(), [&] { load_scene(file); });
    }

    std::string good_glb()
    {
        triangle_gltf().write_glb(folder_.path() / "good.glb");
        std::ifstream stream(folder_.path() / "good.glb", std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    TempFolder folder_;
};

TEST_F(GltfContainerTest, TruncatedAnywhereIsRefused)
{
    const std::string good = good_glb();
    ASSERT_EQ(refusal_of("a.glb", good), "loaded");
    for (std::size_t length = 0; length < good.size(); ++length)
        ASSERT_NE(refusal_of("a.glb", good.substr(0, length)), "loaded") << length;
}

TEST_F(GltfContainerTest, AnyFlippedByteLoadsOrIsRefused)
{
    const std::string good = good_glb();
    int refused = 0;
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x15);
        refused += refusal_of("a.glb", bad) == "loaded" ? 0 : 1;
    }
    EXPECT_GT(refused, 100);  // most of the JSON and the headers matter
}

TEST_F(GltfContainerTest, Headers)
{
    std::string bytes = good_glb();
    bytes[4] = 1;
    EXPECT_EQ(refusal_of("a.glb", bytes), "found GLB version 1, expected version 2");
    bytes = good_glb();
    bytes[16] = 'X';
    EXPECT_EQ(refusal_of("a.glb", bytes),
        "found a first chunk that is not JSON, expected the JSON chunk first");
    bytes = good_glb();
    bytes[14] = 1;  // a JSON chunk of 64 KiB more
    EXPECT_EQ(refusal_of("a.glb", bytes),
        "found a chunk at byte 12 that runs past the end, expected chunks within the file");
    EXPECT_EQ(refusal_of("a.glb", "glTF"), "found 4 bytes, expected a GLB header and a chunk");
    EXPECT_THAT(refusal_of("a.gltf", "{\"asset\": }"),
        testing::StartsWith("/asset at line 1, column 11: found broken JSON"));
}

TEST_F(GltfContainerTest, ABufferNeedsBytes)
{
    GltfBuilder gltf = triangle_gltf();
    EXPECT_EQ(refusal_of("a.gltf", gltf.document.dump()),
        "/buffers/0: found no key \"uri\", expected a uri, or a GLB with a binary chunk");
    gltf.document["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAA";
    EXPECT_EQ(refusal_of("a.gltf", gltf.document.dump()),
        "/buffers/0/byteLength: found 42, expected at most the 3 bytes there are");
}

}  // namespace
}  // namespace farlight
