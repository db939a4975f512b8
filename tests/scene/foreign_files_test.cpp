// Files nobody here made, where they are to be found: each loads or is refused, none crashes.
#include "server/scene/scene_file.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

TEST(ForeignFiles, KhronosSamplesAndMalformedFilesLoadOrAreRefused)
{
    const std::filesystem::path folder = "/usr/share/assimp/models/glTF2";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "Debian's assimp-testmodels is not installed";
    int loaded = 0;
    int refused = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb")
            continue;
        try {
            const Scene scene = load_scene(entry.path());
            EXPECT_FALSE(scene_bounds(scene).empty()) << entry.path();
            ++loaded;
        } catch (const SceneError& error) {
            EXPECT_NE(std::string(error.what()).find(", expected "), std::string::npos);
            ++refused;
        }
    }
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 10);
}

TEST(ForeignFiles, TheBalloonLoads)
{
    const std::filesystem::path source = FARLIGHT_SOURCE_DIR;
    std::filesystem::path file;
    for (const auto& folder : {source / "shared", source.parent_path() / "shared"})
        if (std::filesystem::exists(folder / "data/balloon/scene.gltf"))
            file = folder / "data/balloon/scene.gltf";
    if (file.empty())
        GTEST_SKIP() << "no shared/data/balloon in or beside the source tree";
    const Scene scene = load_scene(file);
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangles.size();
    EXPECT_EQ(triangles, 35698U);
    EXPECT_EQ(scene.materials.size(), 38U);  // 37 and the default lamp's
}

}  // namespace
}  // namespace farlight
