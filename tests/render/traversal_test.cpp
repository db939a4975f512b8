// Traversal on the device against Embree, ray by ray, in models that no formula makes. Formulas are
// the laboratory's: lab/cases_tree.cpp.
#include "lab/ray_probe.h"
#include "tests/support/gl_test.h"

#include <fstream>

namespace farlight {
namespace {

class TraversalTest : public GlTest, public testing::WithParamInterface<const char*> { };

TEST_P(TraversalTest, EqualsEmbreeForAHundredThousandRays)
{
    const std::string root = FARLIGHT_SOURCE_DIR;
    if (!std::ifstream(root + GetParam()))
        GTEST_SKIP() << "the model is not on this machine";
    Scene scene = load_scene(root + GetParam());
    std::erase_if(
        scene.objects, [](const Object& object) { return !object.framed; });  // a default lamp
    const std::vector<TestRay> rays = random_rays(scene_bounds(scene), 100'000, 17);
    const Disagreements found = against_embree(scene, rays);
    EXPECT_EQ(found.wrong, 0U);
    EXPECT_GT(found.met, rays.size() / 10) << "the rays hardly met anything";
}

INSTANTIATE_TEST_SUITE_P(Meshes, TraversalTest,
    testing::Values(
        "/scenes/cornell_box.json", "/scenes/mesh.json", "/../shared/data/balloon/scene.gltf"));

}  // namespace
}  // namespace farlight
