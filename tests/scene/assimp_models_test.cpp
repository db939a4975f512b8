// Files nobody here made: Debian's assimp-testmodels, and models shared beside the source tree.
// Every well-formed one loads, every malformed one gives its error; nothing goes by unnoticed.
#include "server/scene/scene_file.h"
#include "tests/scene/refusal.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <map>
#include <set>

namespace farlight {
namespace {

using testing::HasSubstr;

const std::filesystem::path kAssimp = "/usr/share/assimp/models/glTF2";
const std::filesystem::path kShared = FARLIGHT_DATA_DIR;  // may be "...-NOTFOUND"

/// What the error says of each file that cannot be shown.
const std::map<std::string, const char*> kRefused{
    {"BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf",
        "/extensionsRequired: found KHR_technique_webgl, expected none but extensions that"},
    {"BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb",
        "12 triangles with a corner that is not finite (or beyond 1e11) left out, expected at "
        "least one triangle"},
    {"IncorrectVertexArrays/Cube.gltf",
        "/bufferViews/2/byteLength: found 432, expected at most 10, what the buffer still holds"},
    {"IndexOutOfRange/AllIndicesOutOfRange.gltf",
        "12 triangles with a corner that is no position left out, expected at least one"},
    {"MissingBin/BoxTextured.gltf",
        "/buffers/0/uri: found \"BoxTextured0.bin\", and no such file, expected a file of bytes"},
    {"RecursiveNodes/RecursiveNodes.gltf",
        "/nodes/1/children/0: found node 0 a second time, expected a tree: no cycles"},
    {"SchemaFailures/sceneWrongType.gltf",
        "/scene: found \"hello\", expected an index: an integer from 0"},
    {"TestNoRootNode/NoScene.gltf", "/scenes: found no scene, expected at least one scene"},
    {"TestNoRootNode/SceneWithoutNodes.gltf",
        "/scenes: found no mesh in the scene's nodes, expected at least one"},
    {"wrongTypes/badArray.gltf",
        "/meshes/0/primitives: found an object, expected an array of at least one primitive"},
    {"wrongTypes/badExtension.gltf",
        "KHR_texture_transform: found \"Not an object\", expected an object with offset"},
    {"wrongTypes/badNumber.gltf",
        "/materials/0/normalTexture/scale: found \"not a number\", expected a number"},
    {"wrongTypes/badObject.gltf",
        "/materials/0/pbrMetallicRoughness: found [\"not an object\"], expected an object with"},
    {"wrongTypes/badString.gltf", "/scenes/0/name: found 42, expected a text"},
    {"wrongTypes/badUint.gltf", "baseColorTexture/index: found -1, expected an index"},
};

struct Loaded {
    std::size_t triangles;
    std::size_t images;
    const char* note;  ///< One of the scene's, or nothing.
};

/// What is known of some of the others.
const std::map<std::string, Loaded> kKnown{
    {"IndexOutOfRange/IndexOutOfRange.gltf",
        {11, 0, "1 triangle with a corner that is no position left out"}},
    {"2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
        {65311, 0, "10419 triangles of zero area left out"}},
    {"draco/2CylinderEngine.gltf", {65298, 0, "13 triangles of zero area left out"}},
    {"BoxBadNormals-glTF-Binary/BoxBadNormals.glb",
        {12, 0, "4 shading normals without a direction replaced by the faces around"}},
    {"BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf",
        {12, 1, "extensions that are not read: KHR_materials_pbrSpecularGlossiness"}},
    {"ClearCoat-glTF/ClearCoatTest.gltf", {37116, 6, ""}},
    {"cameras/Cameras.gltf",
        {2, 0, "1 orthographic cameras are perspective ones of 1 degree, seen from afar"}},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf",
        {8192, 0, "1 primitives of points or lines drawn as thin solids"}},
    {"textureTransform/TextureTransformTest.gltf", {18, 5, ""}},
};

std::vector<std::string> models_in(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    std::error_code absent;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, absent))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            names.push_back(std::filesystem::relative(entry.path(), folder).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::size_t triangles_of(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangles.size();
    return triangles;
}

void check_known(const Scene& scene, const Loaded& known)
{
    EXPECT_EQ(triangles_of(scene), known.triangles);
    EXPECT_EQ(scene.images.size(), known.images);
    if (*known.note != '\0') {
        EXPECT_THAT(scene.notes, testing::Contains(known.note));
    }
}

TEST(AssimpModels, EachLoadsOrGivesItsError)
{
    const std::vector<std::string> models = models_in(kAssimp);
    if (models.empty())
        GTEST_SKIP() << "Debian's assimp-testmodels is not installed";
    for (const std::string& model : models) {
        SCOPED_TRACE(model);
        const std::string file = (kAssimp / model).string();
        Scene scene;
        const std::string error = refusal(file, [&] { scene = load_scene(file); });
        const auto expected = kRefused.find(model);
        if (expected != kRefused.end()) {
            EXPECT_THAT(error, HasSubstr(expected->second));
            continue;
        }
        ASSERT_EQ(error, "loaded");
        EXPECT_FALSE(scene_bounds(scene).empty());
        if (const auto known = kKnown.find(model); known != kKnown.end())
            check_known(scene, known->second);
    }
    for (const auto& [model, error] : kRefused)
        EXPECT_THAT(models, testing::Contains(model)) << "a row without its file";
    for (const auto& [model, known] : kKnown)
        EXPECT_THAT(models, testing::Contains(model)) << "a row without its file";
}

TEST(AssimpModels, SkinsAndMorphTargets)
{
    if (models_in(kAssimp).empty())
        GTEST_SKIP() << "Debian's assimp-testmodels is not installed";
    const Scene skin = load_scene(kAssimp / "simple_skin/simple_skin.gltf");
    EXPECT_EQ(skin.animation.nodes.size(), 2U);
    EXPECT_EQ(skin.animation.skins.size(), 1U);
    EXPECT_EQ(skin.animation.tracks.size(), 1U);
    EXPECT_EQ(skin.animation.tracks.at(0).period, 5.5);
    const Scene morph =
        load_scene(kAssimp / "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf");
    EXPECT_EQ(morph.meshes.at(0).morph_targets.size(), 2U);
    EXPECT_EQ(morph.animation.tracks.at(0).times.size(), 127U);
}

TEST(SharedModels, AllLoad)
{
    const std::vector<std::string> models = models_in(kShared);
    if (models.empty())
        GTEST_SKIP() << "no models in FARLIGHT_DATA_DIR, " << kShared;
    const std::map<std::string, Loaded> known{
        {"balloon/scene.gltf", {35698, 17, ""}},
        {"cc0/bunny.glb", {5648, 0, ""}},
        {"cc0/suzi.glb", {14842, 0, ""}},
        {"cc0/pmndrs.glb", {1551, 1, "1 triangle of zero area left out"}},
    };
    for (const std::string& model : models) {
        SCOPED_TRACE(model);
        const Scene scene = load_scene(kShared / model);
        EXPECT_FALSE(scene_bounds(scene).empty());
        if (const auto row = known.find(model); row != known.end())
            check_known(scene, row->second);
    }
}

}  // namespace
}  // namespace farlight
