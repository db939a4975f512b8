// The registry: for every effect a pair of scenes that differ in its bit alone.
#include "server/scene/effects.h"

#include "tests/scene/plain_scene.h"

#include <algorithm>
#include <functional>
#include <gmock/gmock.h>
#include <random>

namespace farlight {
namespace {

using Change = std::function<void(Scene&)>;

void change_material(Scene& scene, const std::function<void(Material&)>& change)
{
    change(scene.materials[0]);
}

struct Pair {
    std::string effect;
    Change without;  ///< What both scenes have besides plain().
    Change with;  ///< What calls for the effect.
};

void glossy(Scene& scene)
{
    scene.materials.push_back({.name = "other", .metallic = 1, .roughness = 0.5F});
    scene.objects.push_back({.name = "bowl", .material = 2, .shape = Sphere{}});
}

void nothing(Scene& /*scene*/) { }

std::vector<Pair> pairs_of_materials()
{
    const auto material = [](auto change) {
        return [change](Scene& scene) { change_material(scene, change); };
    };
    return {
        {"rough_reflection",
            [](Scene& s) {
                glossy(s);
                s.materials[2].roughness = 0;
            },
            material([](Material& m) { m.metallic = 1, m.roughness = 0.3F; })},
        {"mirror", glossy, material([](Material& m) { m.metallic = 1, m.roughness = 0; })},
        {"clearcoat", glossy, material([](Material& m) { m.clearcoat = 1; })},
        {"dielectric", glossy, material([](Material& m) { m.transmission = 1, m.roughness = 0; })},
        {"rough_dielectric",
            [](Scene& s) {
                glossy(s);
                s.materials[2] = {.name = "glass", .roughness = 0, .transmission = 1};
            },
            material([](Material& m) { m.transmission = 1, m.roughness = 0.5F; })},
        {"unlit", nothing, material([](Material& m) { m.unlit = true; })},
        {"alpha", nothing,
            material([](Material& m) { m.alpha_mode = AlphaMode::kBlend, m.opacity = 0.5F; })},
        {"textures", nothing,
            [](Scene& s) {
                s.materials[0].albedo_texture = texture_of(s, {kBlack, kWhite});
            }},
        {"second_uvs",
            [](Scene& s) {
                s.materials[0].albedo_texture = texture_of(s, {kBlack, kWhite});
            },
            [](Scene& s) { s.materials[0].albedo_texture.uv_set = 1; }},
        {"normal_maps",
            [](Scene& s) {
                s.materials[0].albedo_texture = texture_of(s, {kBlack, kWhite});
            },
            [](Scene& s) {
                s.materials[0].normal_texture = texture_of(s, {kFlat, kTilted});
            }},
        {"vertex_colors", nothing,
            [](Scene& s) {
                s.meshes[0].colors = {glm::vec4(1), glm::vec4(0.5F), glm::vec4(1)};
            }},
    };
}

std::vector<Pair> pairs_of_the_rest()
{
    const auto delta = [](Scene& s) { s.lights.push_back({.name = "lamp"}); };
    return {
        {"triangles", [](Scene& s) { s.objects[0].shape = Sphere{}; },
            [](Scene& s) { s.objects.push_back({.name = "quad", .shape = Quad{}}); }},
        {"spheres", nothing,
            [](Scene& s) { s.objects.push_back({.name = "ball", .shape = Sphere{}}); }},
        {"disks", nothing,
            [](Scene& s) { s.objects.push_back({.name = "coin", .shape = Disk{}}); }},
        {"shading_normals", nothing,
            [](Scene& s) { s.meshes[0].normals.assign(3, glm::vec3(0, 0, 1)); }},
        {"sphere_lights",
            [&](Scene& s) {
                s.materials[1].emission = glm::vec3(1);
                s.objects.push_back({.name = "lamp", .material = 1, .shape = Quad{}});
                s.objects.push_back({.name = "ball", .shape = Sphere{}});
            },
            [](Scene& s) {
                s.objects.push_back({.name = "sun", .material = 1, .shape = Sphere{}});
            }},
        {"delta_lights",
            [](Scene& s) {
                s.materials[1].emission = glm::vec3(1);
                s.objects.push_back({.name = "lamp", .material = 1, .shape = Quad{}});
            },
            delta},
        {"background", nothing, [](Scene& s) { s.background = glm::vec3(1); }},
        {"environment_map",
            [=](Scene& s) {
                delta(s);
                s.background = glm::vec3(1);
            },
            [](Scene& s) {
                s.environment = std::make_shared<EnvironmentMap>(
                    EnvironmentMap{"sky.hdr", 2, 1, {glm::vec3(1), glm::vec3(2)}});
            }},
        {"fog", nothing,
            [](Scene& s) {
                s.medium = {"haze", glm::vec3(0.02F), glm::vec3(0), 0};
            }},
        {"lens", nothing, [](Scene& s) { s.lens.radius = 0.1; }},
    };
}

std::vector<Pair> all_pairs()
{
    std::vector<Pair> pairs = pairs_of_materials();
    for (Pair& pair : pairs_of_the_rest())
        pairs.push_back(std::move(pair));
    return pairs;
}

TEST(EffectsTest, PairsOfScenesDifferInOneBit)
{
    for (const Pair& pair : all_pairs()) {
        Scene scene = plain();
        pair.without(scene);
        const EffectMask without = mask_of_scene(scene);
        pair.with(scene);
        const EffectMask with = mask_of_scene(scene);
        EXPECT_FALSE(without.has(pair.effect)) << pair.effect;
        EXPECT_THAT(with.without(without).names(), testing::ElementsAre(pair.effect));
        EXPECT_TRUE(without.without(with).empty() || pair.effect == "triangles") << pair.effect;
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
