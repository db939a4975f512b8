// glTF that asks for more than there is: more elements than bytes, more memory than the machine
// has; and scenes of no size.
#include "lab/temp_folder.h"
#include "server/scene/camera_limits.h"
#include "server/scene/scene_error.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/refusal.h"

#include <fstream>
#include <gmock/gmock.h>
#include <iostream>
#include <sys/resource.h>
#include <unistd.h>

namespace farlight {
namespace {

using Json = nlohmann::json;

class GltfLimitsTest : public testing::Test {
protected:
    std::string outcome_of(const GltfBuilder& gltf)
    {
        gltf.write_glb(file_);
        return refusal(file_.string(), [&] { load_scene(file_); });
    }

    /// The triangle's corners as points, over and over.
    static GltfBuilder points(std::size_t count, int primitives)
    {
        GltfBuilder gltf = triangle_gltf();
        const int indices = gltf.add(std::vector<std::uint8_t>(count), "SCALAR");
        const Json primitive{{"attributes", {{"POSITION", 0}}}, {"indices", indices}, {"mode", 0}};
        gltf.document["meshes"][0]["primitives"] =
            std::vector<Json>(static_cast<std::size_t>(primitives), primitive);
        return gltf;
    }

    TempFolder folder_;
    std::filesystem::path file_ = folder_.path() / "model.glb";
};

TEST_F(GltfLimitsTest, ZerosGrowWithTheFile)
{
    GltfBuilder gltf = triangle_gltf();
    const auto with_zeros = [&](std::uint32_t count) {
        gltf.document["accessors"][2] = {
            {"componentType", 5126}, {"count", count}, {"type", "VEC3"}};
        return outcome_of(gltf);
    };
    EXPECT_EQ(with_zeros(1U << 16U), "loaded");
    EXPECT_EQ(with_zeros((1U << 16U) + 1),
        "/accessors/2/count: found 65537, expected at most 65536 without a bufferView in a file of "
        "this size");
    gltf.add_view(std::string(100'000 - gltf.bytes.size() - 2, 'x'));
    EXPECT_EQ(gltf.bytes.size(), 100'000U);
    EXPECT_EQ(with_zeros(800'000), "loaded");
    EXPECT_NE(with_zeros(800'001), "loaded");
}

TEST_F(GltfLimitsTest, PointsAreCountedBeforeTheyAreMade)
{
    constexpr std::size_t kMost = (1U << 24U) / 8;
    EXPECT_EQ(outcome_of(points(kMost + 1, 1)),
        "/meshes/0/primitives/0: found points or lines that take 16777224 triangles, 16777224 with "
        "those before, expected at most 16777216 in a file");
    EXPECT_EQ(outcome_of(points(kMost / 2 + 1, 2)),
        "/meshes/0/primitives/1: found points or lines that take 8388616 triangles, 16777232 with "
        "those before, expected at most 16777216 in a file");
}

TEST_F(GltfLimitsTest, MemoryThatIsNotToBeHadIsARefusal)
{
    const ScenePlace place{"big.glb", "/meshes/0"};
    const auto told = [&](const auto& load) {
        return refusal("big.glb", [&] { within_memory(place, load); });
    };
    const char* const expected = "/meshes/0: found more than fits in memory, expected a smaller "
                                 "scene, or a machine with more memory";
    EXPECT_EQ(told([]() -> int { throw std::bad_alloc(); }), expected);
    EXPECT_EQ(told([]() -> int { throw std::length_error("vector"); }), expected);
    EXPECT_EQ(told([] { return 1; }), "loaded");
}

#ifndef __SANITIZE_ADDRESS__  // which reserves most of the address space

/// Loads with 64 MiB more than are in use, says what came of it on standard error, and ends.
[[noreturn]] void load_in_little_memory(const std::filesystem::path& file)
{
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (64U << 20U);
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
    std::cerr << refusal(file.string(), [&] { load_scene(file); }) << std::flush;
    std::_Exit(0);
}

TEST_F(GltfLimitsTest, LoadingMoreThanFitsInMemoryIsARefusal)
{
    points(1'000'000, 1).write_glb(file_);  // 8 million triangles
    EXPECT_EXIT(load_in_little_memory(file_), testing::ExitedWithCode(0),
        "^found more than fits in memory, expected a smaller scene");
}

#endif

TEST_F(GltfLimitsTest, ASkinThatOverflowsIsRefused)
{
    GltfBuilder gltf = triangle_gltf();
    Json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = gltf.add(std::vector<std::uint8_t>(12), "VEC4");
    attributes["WEIGHTS_0"] = gltf.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    std::vector<float> bind(16, 0);
    bind[0] = bind[5] = bind[10] = 3e38F;
    bind[15] = 1;
    gltf.document["skins"] = {
        {{"joints", {1}}, {"inverseBindMatrices", gltf.add<float>(bind, "MAT4")}}};
    gltf.document["nodes"][0]["skin"] = 0;
    gltf.document["nodes"].push_back({{"scale", {4, 4, 4}}});
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    EXPECT_EQ(outcome_of(gltf),
        "found objects beyond 1e11 in world space, expected coordinates of at most 1e11 in "
        "magnitude");
}

TEST_F(GltfLimitsTest, ASceneWithoutSizeIsSeenFromSomewhere)
{
    GltfBuilder gltf = triangle_gltf();
    const int joints = gltf.add(std::vector<std::uint8_t>(12), "VEC4");
    const int weights = gltf.add<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
    Json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = joints;
    attributes["WEIGHTS_0"] = weights;
    gltf.document["skins"] = {{{"joints", {1}}}};
    gltf.document["nodes"][0]["skin"] = 0;
    gltf.document["nodes"].push_back({{"scale", {0, 0, 0}}});
    gltf.document["nodes"].push_back({{"camera", 0}});
    gltf.document["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    for (const Json& nodes : {Json{0, 1}, Json{0, 1, 2}}) {  // the second with its own camera
        gltf.document["scenes"][0]["nodes"] = nodes;
        gltf.write_glb(file_);
        const Scene scene = load_scene(file_);
        ASSERT_EQ(scene_bounds(scene).radius(), 0);
        const CameraPose& camera = scene.camera;
        EXPECT_GT(glm::length(camera.target - camera.position),
            nearest_target(camera.position, camera.target));
    }
}

}  // namespace
}  // namespace farlight
