// The registry: for every effect a pair of scenes that differ in its bit alone, reasons that people
// read, and sets of effects.
#include "server/scene/effects.h"

#include "tests/scene/plain_scene.h"
#include "tests/support/effect_pairs.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <random>

namespace farlight {
namespace {

TEST(EffectsTest, EveryEffectHasItsPairOfScenes)
{
    std::vector<std::string_view> paired;
    for (const EffectPair& pair : effect_pairs())
        paired.push_back(pair.effect);
    std::vector<std::string_view> registered;
    for (const Effect& effect : effect_registry())
        registered.push_back(effect.name);
    EXPECT_THAT(paired, testing::UnorderedElementsAreArray(registered));
}

TEST(EffectsTest, PairsOfScenesDifferInOneBit)
{
    for (const EffectPair& pair : effect_pairs()) {
        Scene scene = lit_scene();
        pair.without(scene);
        const EffectMask without = mask_of_scene(scene);
        pair.with(scene);
        const EffectMask with = mask_of_scene(scene);
        std::vector<std::string_view> expected = pair.along;
        const auto& rows = effect_registry();
        const bool by_setting = std::any_of(rows.begin(), rows.end(), [&](const Effect& effect) {
            return effect.name == pair.effect && !effect.setting.empty();
        });
        if (!by_setting)
            expected.push_back(pair.effect);
        EXPECT_FALSE(without.has(pair.effect)) << pair.effect;
        EXPECT_THAT(with.without(without).names(), testing::UnorderedElementsAreArray(expected));
        EXPECT_TRUE(without.without(with).empty()) << pair.effect;
    }
}

TEST(EffectsTest, TracksCount)
{
    Scene scene = plain();
    scene.lights.push_back({.name = "lamp"});
    Track track;
    track.target = Track::Target::kLightIntensity;
    track.times = {0, 1};
    track.values = {0, 1};  // off at first
    scene.animation.tracks.push_back(track);
    EXPECT_TRUE(mask_of_scene(scene).has("delta_lights"));
    EXPECT_FALSE(mask_of_scene(scene).has("motion"));

    scene.animation.tracks.push_back(moving_track());
    const EffectMask moving = mask_of_scene(scene);
    EXPECT_TRUE(moving.has("FX_MOTION"));
    EXPECT_TRUE(moving.has("FX_INSTANCES"));
}

/// Even where a scene says in a roundabout way that nothing changes its shape.
TEST(EffectsTest, WhatIsPackedToDeformIsCalledFor)
{
    Scene scene = plain();
    scene.meshes[0].morph_targets = {{{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}}, {}}};
    std::get<MeshInstance>(scene.objects[0].shape).morph_weights = {0};
    scene.animation.tracks.push_back(moving_track());
    for (const bool neutral : {false, true}) {
        if (neutral)
            drop_neutral(scene);
        const PackedScene packed = pack_scene(scene);
        const EffectMask mask = mask_of(active_effects(scene, packed.content));
        EXPECT_EQ(mask.has("deformation"), !packed.moving->deforming().prev_vertices.empty());
        EXPECT_EQ(mask.has("motion"), !packed.moving->prev_instances().empty());
        EXPECT_EQ(mask.has("deformation"), !neutral);
        EXPECT_EQ(mask.has("motion"), neutral);
    }
}

TEST(EffectsTest, ReasonsNameTheFirstThingThatCallsForTheEffect)
{
    Scene scene = plain();
    scene.medium = {"haze", glm::vec3(0.02F), glm::vec3(0), 0};
    scene.materials[0].metallic = 1;
    scene.lights.push_back({.name = "off", .intensity = glm::vec3(0)});
    scene.lights.push_back(
        {.name = "spot", .kind = PunctualLight::Kind::kSpot, .intensity = glm::vec3(3)});
    drop_neutral(scene);
    std::vector<std::string> reasons;
    for (const ActiveEffect& effect : active_effects(scene, pack_scene(scene).content))
        reasons.push_back(std::string(effect.name) + ": " + effect.reason);
    EXPECT_THAT(reasons,
        testing::ElementsAre("triangles: 1 triangles, first 'sail'",
            "lights: spot light 'spot', intensity 3",
            "delta_lights: spot light 'spot', intensity 3",
            "rough_reflection: material 'paint' of 'sail', rough reflection",
            "fog: medium 'haze', sigma_t 0.02 1/m",
            "specular_signal: material 'paint' of 'sail', glossy"));
}

TEST(EffectMaskTest, ContainsWhatItIsMadeOfAndNoMore)
{
    std::mt19937_64 random(11);
    const std::size_t rows = effect_registry().size();
    for (int i = 0; i < 100; ++i) {
        EffectMask small;
        EffectMask large;
        for (std::size_t row = 0; row < rows; ++row) {
            if (random() % 3 == 0)
                small = small | mask_of_row(row);
            if (random() % 2 == 0)
                large = large | mask_of_row(row);
        }
        const EffectMask both = small | large;
        EXPECT_TRUE(both.contains(small) && both.contains(large));
        EXPECT_EQ(small.contains(both), both == small);
        EXPECT_EQ(EffectMask::of(both.names()) | both, EffectMask::of(both.names()));
        EXPECT_EQ(both.without(large) | large, both);
    }
}

TEST(EffectMaskTest, NamesComeWithWhatTheyNeed)
{
    const EffectMask mask = EffectMask::of({"normal_maps", "fog"});
    EXPECT_THAT(mask.names(), testing::ElementsAre("textures", "normal_maps", "fog"));
    EXPECT_THAT(mask.macros(), testing::ElementsAre("FX_TEXTURES", "FX_NORMAL_MAPS", "FX_FOG"));
    EXPECT_THROW(EffectMask::of({"fgo"}), std::invalid_argument);
    for (const Effect& effect : effect_registry())
        EXPECT_TRUE(EffectMask::general().has(effect.name) || effect.macro.empty()) << effect.name;
}

TEST(EffectRegistryTest, NamesAndMacrosAreUsable)
{
    std::vector<std::string> seen;
    for (const Effect& effect : effect_registry()) {
        EXPECT_TRUE(std::all_of(effect.name.begin(), effect.name.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || c == '_';
        })) << effect.name;
        EXPECT_TRUE(effect.macro.empty() || effect.macro.starts_with("FX_")) << effect.macro;
        EXPECT_FALSE(effect.disappears.empty()) << effect.name;
        seen.emplace_back(effect.name);
        seen.emplace_back(effect.macro);
    }
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

}  // namespace
}  // namespace farlight
