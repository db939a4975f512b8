// Every effect has a shipped scene, and every shipped scene the effects that it is named for.
#include "server/scene/effects.h"
#include "server/scene/gpu_scene.h"
#include "server/scene/neutral.h"
#include "server/scene/scene_file.h"

#include <gmock/gmock.h>
#include <set>
#include <sstream>

namespace farlight {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";

using Names = std::set<std::string>;

Names words(const std::string& text)
{
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

Names effects_of(const std::string& scene_name)
{
    Scene scene = load_scene(kScenes / (scene_name + ".json"));
    drop_neutral(scene);
    Names names;
    for (const ActiveEffect& effect : active_effects(scene, pack_scene(scene).content))
        names.emplace(effect.name);
    return names;
}

struct ScenesEffects {
    const char* scene;
    const char* effects;  ///< Besides those of kStage.
};

/// What most scenes have so that there is something to see, and what follows from other effects.
const char* const kStage =
    "triangles spheres lights polygon_lights background light_tree specular_signal";

// The Cornell box, the four spheres and the furnace have no more than kStage.
constexpr std::array kShipped{ScenesEffects{"cornell_box", ""}, ScenesEffects{"four_spheres", ""},
    ScenesEffects{"furnace", "emissive_meshes"}, ScenesEffects{"mesh", "shading_normals"},
    ScenesEffects{"white_furnace", ""}, ScenesEffects{"point_furnace", "delta_lights"},
    ScenesEffects{"glass_furnace", "dielectric mirror"},
    ScenesEffects{"disk_light", "disks disk_lights"},
    ScenesEffects{"linear_sky", "environment_map"}, ScenesEffects{"absorbing_fog", "fog"},
    ScenesEffects{"punctual_lights", "delta_lights"},
    ScenesEffects{"emissive_mesh", "emissive_meshes shading_normals"},
    ScenesEffects{"many_lights", ""}, ScenesEffects{"environment", "environment_map"},
    ScenesEffects{"textures", "textures"},
    ScenesEffects{"second_uvs", "textures second_uvs emissive_meshes"},
    ScenesEffects{"normal_map", "textures normal_maps"},
    ScenesEffects{"vertex_colors", "vertex_colors"},
    ScenesEffects{"roughness_row", "rough_reflection textures"}, ScenesEffects{"mirror", "mirror"},
    ScenesEffects{"clearcoat", "clearcoat rough_reflection"},
    ScenesEffects{"glass", "dielectric mirror"},
    ScenesEffects{"rough_glass", "dielectric rough_dielectric rough_reflection"},
    ScenesEffects{"nested_glass", "dielectric mirror"}, ScenesEffects{"alpha", "alpha textures"},
    ScenesEffects{"unlit", "unlit textures"}, ScenesEffects{"fog", "fog delta_lights"},
    ScenesEffects{"lens", "lens sphere_lights"}, ScenesEffects{"instances", "shading_normals"},
    ScenesEffects{"moving", "motion instances shading_normals delta_lights"},
    ScenesEffects{"deforming", "deformation shading_normals"},
    ScenesEffects{"fog_and_alpha", "fog alpha textures delta_lights"},
    ScenesEffects{"lens_and_mirror", "lens mirror"},
    ScenesEffects{"glass_in_fog", "dielectric mirror fog"},
    ScenesEffects{"worn_metal", "rough_reflection textures normal_maps"},
    ScenesEffects{"lantern", "emissive_meshes environment_map shading_normals"},
    ScenesEffects{"still_life",
        "alpha clearcoat dielectric environment_map lens mirror normal_maps rough_dielectric "
        "rough_reflection shading_normals sphere_lights textures"},
    ScenesEffects{"everything",
        "alpha clearcoat deformation delta_lights dielectric disk_lights disks emissive_meshes "
        "environment_map fog instances lens mirror motion normal_maps rough_dielectric "
        "rough_reflection second_uvs shading_normals sphere_lights textures unlit vertex_colors"}};

class ShippedEffectsTest : public testing::TestWithParam<ScenesEffects> { };

void PrintTo(const ScenesEffects& row, std::ostream* out)
{
    *out << row.effects;
}

TEST_P(ShippedEffectsTest, AreThoseTheSceneIsNamedForAndNoOthers)
{
    Names effects = effects_of(GetParam().scene);
    for (const std::string& usual : words(kStage))
        effects.erase(usual);
    EXPECT_EQ(effects, words(GetParam().effects));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedEffectsTest, testing::ValuesIn(kShipped),
    [](const auto& row) { return row.param.scene; });

TEST(ShippedEffects, EverySceneIsListed)
{
    Names files;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            files.insert(entry.path().stem());
    Names listed;
    for (const ScenesEffects& row : kShipped)
        listed.insert(row.scene);
    EXPECT_EQ(files, listed);
}

TEST(ShippedEffects, OneSceneCallsForAllThatScenesCanCallFor)
{
    const Names everything = effects_of("everything");
    for (const Effect& effect : effect_registry())
        EXPECT_EQ(everything.contains(std::string(effect.name)), effect.setting.empty())
            << effect.name;
}

TEST(ShippedEffects, ManyLightsCallForATree)
{
    EXPECT_TRUE(effects_of("many_lights").contains("light_tree"));
    EXPECT_FALSE(effects_of("cornell_box").contains("light_tree"));
}

}  // namespace
}  // namespace farlight
