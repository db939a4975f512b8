// What a scene says about settings: who wins, and what is refused where.
#include "server/render/scene_settings.h"
#include "tests/support/shipped_scenes.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

Scene scene_with(const std::string& settings)
{
    return parse_scene(R"({"version": 1, "materials": {"m": {}}, "settings": )" + settings
            + R"(, "objects": [{"material": "m", "sphere": {"center": [0, 0, 0], "radius": 1}}]})",
        {}, "s.json");
}

SceneError refusal_of(const std::string& settings, const std::vector<ActiveEffect>& effects = {})
{
    try {
        check_settings(scene_with(settings), effects);
    } catch (const SceneError& error) {
        return error;
    }
    return SceneError("nothing was refused");
}

TEST(SceneSettingsTest, WinOverTheDefaultsAndLoseToTheCommandLine)
{
    const Scene scene = scene_with(
        R"({"max_depth": 12, "exposure": 2.5, "denoiser": "none", "play": false, "seed": 4294967295})");
    const RenderSettings settings =
        settings_for(scene, RenderSettings{}, {"exposure=4", "max_depth=7", "max_depth=9"});
    EXPECT_EQ(settings.max_depth, 9);
    EXPECT_EQ(settings.exposure, 4);
    EXPECT_EQ(settings.denoiser, Denoiser::kOff);
    EXPECT_FALSE(settings.play);
    EXPECT_EQ(settings.seed, 4294967295U);
    EXPECT_EQ(settings.history_max, RenderSettings{}.history_max);
    EXPECT_EQ(settings_for(scene_with("{}"), RenderSettings{}, {}), RenderSettings{});
}

TEST(SceneSettingsTest, WhatTheTableRefusesIsRefusedWithItsPlace)
{
    const SceneError deep = refusal_of(R"({"max_depth": 65})");
    EXPECT_STREQ(deep.what(),
        "s.json: /settings/max_depth: setting 'max_depth': found 65, expected a whole number from "
        "1 to 64");
    EXPECT_EQ(deep.pointer, "/settings/max_depth");
    EXPECT_EQ(refusal_of(R"({"max_depth": 2.5})").pointer, "/settings/max_depth");
    EXPECT_EQ(refusal_of(R"({"denoiser": "oidn"})").pointer, "/settings/denoiser");
    EXPECT_EQ(refusal_of(R"({"a/b~c": 1})").pointer, "/settings/a~1b~0c");
    EXPECT_THAT(refusal_of(R"({"sharpness": 1})").what(), testing::HasSubstr("is unknown"));
}

TEST(SceneSettingsTest, WhatIsNoValueIsRefusedByTheSchema)
{
    for (const auto* const wrong : {"[1]", R"({"max_depth": [4]})", R"({"max_depth": null})"})
        EXPECT_THROW(scene_with(wrong), SceneError) << wrong;
}

TEST(SceneSettingsTest, EffectsMustHoldWhatTheSceneCallsFor)
{
    const std::vector<ActiveEffect> calls{{"fog", "FX_FOG", "medium 'haze'"}};
    EXPECT_STREQ(refusal_of(R"({"effects": "fog,lens"})", calls).what(), "nothing was refused");
    EXPECT_STREQ(refusal_of(R"({"effects": "general"})", calls).what(), "nothing was refused");
    const SceneError less = refusal_of(R"({"effects": "lens"})", calls);
    EXPECT_EQ(less.pointer, "/settings/effects");
    EXPECT_THAT(less.what(), testing::HasSubstr("medium 'haze'"));
    EXPECT_EQ(refusal_of(R"({"effects": "sparkle"})", calls).pointer, "/settings/effects");
}

TEST(SceneSettingsTest, ShippedScenesSayWhatTheTableKnows)
{
    int some = 0;
    for (const auto& file : shipped_scenes()) {
        const Scene scene = load_scene(file);
        EXPECT_NO_THROW(check_settings(scene, {})) << file;
        some += scene.settings.empty() ? 0 : 1;
    }
    EXPECT_GT(some, 3);
}

}  // namespace
}  // namespace farlight
