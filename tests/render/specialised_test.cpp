// A program with only the effects that a scene calls for gives the same bits as the one with all.
#include "tests/render/same_bits.h"
#include "tests/scene/plain_scene.h"
#include "tests/support/moving_scenes.h"
#include "tests/support/random_scene.h"
#include "tests/support/shipped_scenes.h"

#include <numeric>

namespace farlight {
namespace {

unsigned seed_of(const std::string& scene)
{
    return std::accumulate(scene.begin(), scene.end(), 7U,
        [](unsigned sum, char c) { return 31 * sum + static_cast<unsigned char>(c); });
}

std::vector<std::string> scene_names()
{
    std::vector<std::string> names;
    for (const auto& file : shipped_scenes())
        names.push_back(file.stem());
    return names;
}

class SpecialisedTest : public GlTest, public testing::WithParamInterface<std::string> { };

TEST_P(SpecialisedTest, EqualsTheGeneralProgramBitForBit)
{
    const Subject subject(shipped_scene(GetParam() + ".json"));
    expect_as_general(subject, {}, {list({})}, GetParam());
}

/// Every effect, and those that meet; all scenes are in the long form.
INSTANTIATE_TEST_SUITE_P(Scenes, SpecialisedTest,
    testing::Values("cornell_box", "four_spheres", "fog_and_alpha", "lens_and_mirror",
        "glass_in_fog", "worn_metal", "lantern", "moving", "deforming", "everything"),
    [](const auto& test) { return test.param; });

/// More than the scene calls for, and less than all.
class SupersetTest : public SpecialisedTest { };

TEST_P(SupersetTest, EqualsTheGeneralProgramBitForBit)
{
    const Subject subject(shipped_scene(GetParam() + ".json"));
    std::mt19937 random(seed_of(GetParam()));
    expect_as_general(subject, {}, {list(random_superset(subject.mask(), random))}, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, SupersetTest, testing::Values("cornell_box", "lens_and_mirror"),
    [](const auto& test) { return test.param; });

/// What no shipped scene is small enough for: something that rests in a space of its own.
TEST_F(GlTest, SpecialisedEqualsGeneralForInstancesAtRest)
{
    Scene scene = shipped_scene("cornell_box.json");
    scene.animation.nodes.push_back({.name = "holder"});
    scene.animation.nodes.back().translation = scene_bounds(scene).center();
    scene.animation.nodes.back().scale = glm::dvec3(0.3, 0.2, 0.1) * scene_bounds(scene).radius();
    scene.objects.push_back({.name = "egg", .shape = Sphere{}, .node = 0});
    const Subject subject(std::move(scene));
    ASSERT_TRUE(subject.mask().has("instances"));
    ASSERT_FALSE(subject.mask().has("motion"));
    expect_as_general(subject, {}, {list({})}, "egg");
}

/// As many samples as fog would need another dispatch for: a program that could draw fog must not
/// add them up in another order.
TEST_F(GlTest, SpecialisedEqualsGeneralForManySamplesAtOnce)
{
    RenderSettings many = averaging();
    many.samples_per_pixel = 40;
    const Subject subject(shipped_scene("cornell_box.json"));
    expect_as_general(subject, many, {list({})}, "cornell_box");
}

/// What changes its shape with time, might, or no longer does, each on something that moves.
TEST_F(GlTest, SpecialisedEqualsGeneralWhereAShapeRests)
{
    for (const auto& [what, scene] : resting_shapes()) {
        const Subject subject(scene);
        EXPECT_FALSE(subject.mask().has("deformation")) << what;
        expect_as_general(subject, {}, {list({})}, what);
    }
}

/// Many effects at once in pictures of nothing in particular, with its own programs, and with more
/// than it calls for.
void expect_random_scenes_as_general(unsigned seed, int count, int superset_every)
{
    std::mt19937 random(seed);
    for (int i = 0; i < count; ++i) {
        std::string what;
        const Subject subject(random_scene(random, what));
        std::vector<EffectChoice> choices{list({})};
        if (i % superset_every == 0)
            choices.push_back(list(random_superset(subject.mask(), random)));
        expect_as_general(subject, i % 2 == 0 ? RenderSettings{} : averaging(), choices, what);
    }
}

TEST_F(GlTest, SpecialisedEqualsGeneralForRandomScenes)
{
    expect_random_scenes_as_general(2, 3, 3);
}

/// Minutes: run by ctest -L long.
class SpecialisedLongTest : public SpecialisedTest { };

TEST_P(SpecialisedLongTest, EqualsTheGeneralProgramBitForBit)
{
    const Subject subject(shipped_scene(GetParam() + ".json"));
    std::mt19937 random(seed_of(GetParam()));
    std::vector<EffectChoice> choices{list({})};
    for (int i = 0; i < 4; ++i)
        choices.push_back(list(random_superset(subject.mask(), random)));
    expect_as_general(subject, {}, choices, GetParam());
    RenderSettings many = averaging();
    many.samples_per_pixel = 3;
    many.max_depth = 9;
    expect_as_general(subject, many, choices, GetParam() + " averaged");
}

INSTANTIATE_TEST_SUITE_P(Scenes, SpecialisedLongTest, testing::ValuesIn(scene_names()),
    [](const auto& test) { return test.param; });

class RandomScenesLongTest : public GlTest { };

TEST_F(RandomScenesLongTest, EqualTheGeneralProgramBitForBit)
{
    expect_random_scenes_as_general(21, 25, 1);
}

/// Each effect compiled in for nothing.
class LeaveOneInLongTest : public GlTest, public testing::WithParamInterface<std::string> { };

TEST_P(LeaveOneInLongTest, ChangesNoBitOfAPlainScene)
{
    const Subject subject(shipped_scene("cornell_box.json"));
    const EffectMask more = EffectMask::of({GetParam()});
    expect_as_general(subject, {}, {list(more)}, GetParam());
}

std::vector<std::string> compiled_effects()
{
    std::vector<std::string> names;
    for (const std::string_view name : EffectMask::general().names())
        names.emplace_back(name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Effects, LeaveOneInLongTest, testing::ValuesIn(compiled_effects()),
    [](const auto& test) { return test.param; });

}  // namespace
}  // namespace farlight
