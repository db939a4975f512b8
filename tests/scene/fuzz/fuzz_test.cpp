// The short form of fuzzing, without libFuzzer: seeds, and mutations of them from a fixed seed.
#include "tests/scene/fuzz/mutation.h"
#include "tests/scene/fuzz/seeds.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

constexpr int kMutations = 100;  // a seed: all of them take some seconds

class FuzzSeedTest : public testing::TestWithParam<Seed> { };

TEST_P(FuzzSeedTest, LoadsItselfAndMutatedLoadsOrIsRefused)
{
    const Seed& seed = GetParam();
    EXPECT_EQ(load_input(seed.format, seed.bytes), "loaded");
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < kMutations; ++i) {
        SceneParts parts = split_scene(seed.format, seed.bytes);
        mutate_scene(parts, random);
        const std::string input = join_scene(seed.format, parts);
        const std::string outcome = load_input(seed.format, input);
        ASSERT_TRUE(outcome == "loaded" || outcome == "refused")
            << outcome << " in mutation " << i << ":\n"
            << parts.json.substr(0, 10000);
        refused += outcome == "refused" ? 1 : 0;
    }
    EXPECT_GT(refused, 0) << "mutations that break nothing test nothing";
}

INSTANTIATE_TEST_SUITE_P(All, FuzzSeedTest, testing::ValuesIn(fuzz_seeds()), [](const auto& row) {
    std::string name = row.param.name;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

}  // namespace
}  // namespace farlight
