// Which programs draw a scene, and that changing them, or the scene, between frames costs nobody
// anything but what it must.
#include "server/render/live_scene.h"
#include "tests/support/gl_test.h"
#include "tests/support/meshes.h"

#include <atomic>
#include <functional>
#include <gmock/gmock.h>

namespace farlight {
namespace {

const EffectChoice kAuto{};
const EffectChoice kGeneral{EffectChoice::Kind::kGeneral, EffectMask::general()};

Scene foggy(Scene scene)
{
    scene.medium = {"haze", glm::vec3(0.1F), glm::vec3(0.1F), 0};
    return scene;
}

class SceneProgramsTest : public GlTest {
protected:
    RenderedFrame draw(View& view, const Scene& scene, const EffectChoice& effects = kAuto)
    {
        RenderSettings settings;
        settings.effects = effects;
        return view.render(linear_request(scene, {32, 24}, settings));
    }

    std::atomic<int> woken_ = 0;
    RendererOptions options_;
    const Scene room_ = room_with(bumpy_sphere(12, 6));
};

TEST_F(SceneProgramsTest, GeneralProgramsDrawUntilTheScenesOwnAreReadyAndHistoryGoesOn)
{
    LiveScene live(context(), options_, [this] { ++woken_; });
    live.show(load_onto_device(room_));
    live.prepare_programs({});
    View view(live.shared());
    const RenderedFrame first = draw(view, room_, kGeneral);
    EXPECT_EQ(first.effects, EffectMask::general());
    EXPECT_THAT(first.constants, testing::Contains(testing::Pair("BVH_STACK_SIZE", 64)));
    live.finish_programs();
    EXPECT_EQ(woken_, 1);
    const RenderedFrame second = draw(view, room_);
    EXPECT_EQ(second.effects, mask_of(live.gpu().effects()));
    EXPECT_FALSE(second.history_reset);
    // What the tree of some hundred triangles may need, far from the deepest there is.
    EXPECT_THAT(second.constants,
        testing::Contains(
            testing::Pair("BVH_STACK_SIZE", testing::AllOf(testing::Gt(3), testing::Lt(32)))));

    View always_general(live.shared());
    draw(always_general, room_, kGeneral);
    EXPECT_EQ(draw(always_general, room_, kGeneral).image.bytes, second.image.bytes)
        << "the swap shows";
}

TEST_F(SceneProgramsTest, ASceneThatCallsForMoreIsDrawnWithItAtOnce)
{
    LiveScene live(context(), options_, [] {});
    live.show(load_onto_device(room_));
    live.prepare_programs({});
    live.finish_programs();
    View view(live.shared());
    const RenderedFrame before = draw(view, room_);
    EXPECT_FALSE(before.effects.has("fog"));

    live.show(load_onto_device(foggy(room_)));
    const RenderedFrame after = draw(view, room_);
    EXPECT_TRUE(after.effects.has("fog")) << "the first frame of the new scene has its fog";
    EXPECT_FALSE(after.history_reset);
    EXPECT_NE(after.image.bytes, before.image.bytes);

    live.finish_programs();
    EXPECT_EQ(draw(view, room_).effects, mask_of(live.gpu().effects()));

    // Without fog again, the smaller programs are still there.
    live.show(load_onto_device(room_));
    EXPECT_EQ(draw(view, room_).effects, before.effects);
}

/// Edit upon edit, faster than any compiler: no frame shows a scene with programs of another.
TEST_F(SceneProgramsTest, NoFrameLacksWhatAnEditHasBrought)
{
    const std::function<void(Scene&)> edits[] = {
        [](Scene& s) { s.lens.radius = 0.05; },
        [](Scene& s) { s.materials[s.objects[0].material].metallic = 1; },
        [](Scene& s) {
            s.medium = {"haze", glm::vec3(0.1F), glm::vec3(0.1F), 0};
        },
        [](Scene& s) { s.lights.push_back({.name = "lamp", .intensity = glm::vec3(2)}); },
        [](Scene& s) { s.medium = {}; },
        [](Scene& s) { s.background = glm::vec3(0.3F); },
    };
    LiveScene live(context(), options_, [] {});
    Scene scene = room_;
    live.show(load_onto_device(scene));
    live.prepare_programs({});
    live.finish_programs();
    View view(live.shared());
    draw(view, scene);
    for (const auto& edit : edits) {
        edit(scene);
        live.show(load_onto_device(scene));
        const EffectMask called_for = mask_of(live.gpu().effects());
        EXPECT_TRUE(draw(view, scene).effects.contains(called_for));
        View fresh(live.shared());
        const RenderedFrame shown = draw(fresh, scene);
        EXPECT_TRUE(shown.effects.contains(called_for));
        View general(live.shared());
        EXPECT_EQ(draw(general, scene, kGeneral).image.bytes, shown.image.bytes);
    }
}

TEST_F(SceneProgramsTest, AListHoldsWhatTheSceneCallsForAnyway)
{
    LiveScene live(context(), options_, [] {});
    live.show(load_onto_device(foggy(room_)));
    View view(live.shared());
    const EffectChoice lens{EffectChoice::Kind::kList, EffectMask::of({"lens"})};
    const RenderedFrame frame = draw(view, room_, lens);
    EXPECT_TRUE(frame.effects.has("lens"));
    EXPECT_TRUE(frame.effects.contains(mask_of(live.gpu().effects())));
    EXPECT_FALSE(frame.effects.has("textures"));
}

TEST_F(SceneProgramsTest, WhatASceneLacksIsInNoProgramNoBufferAndNoPass)
{
    struct Absence {
        const char* effect;
        const char* variable;  ///< Of the path tracer or the G-buffer, only with the effect.
    };
    const Absence absences[] = {{"spheres", "spheres"}, {"disks", "disks"},
        {"shading_normals", "normals"}, {"textures", "uvs"}, {"textures", "texture_array_0"},
        {"normal_maps", "tangents"}, {"vertex_colors", "colors"}, {"fog", "fog_center"},
        {"lens", "lens_radius"}, {"specular_signal", "out_specular"}};
    const GpuScene gpu(Scene{room_});
    const Defines special = gpu.defines();
    Defines general = special;
    for (const std::string_view macro : EffectMask::general().macros())
        general.emplace_back(macro, "1");
    ProgramCache programs;
    const auto has = [&](const Defines& defines, const char* variable) {
        for (const char* shader : {"gbuffer/gbuffer.comp", "path_trace/path_trace.comp"})
            if (programs.get(shader, defines).uniforms().contains(variable))
                return true;
        return false;
    };
    for (const Absence& absence : absences) {
        EXPECT_FALSE(mask_of(gpu.effects()).has(absence.effect)) << absence.effect;
        EXPECT_FALSE(has(special, absence.variable)) << absence.variable;
        EXPECT_TRUE(has(general, absence.variable))
            << absence.variable << " is no variable: mend this test";
        for (const Allocation& allocation : gpu.allocations())
            EXPECT_NE(allocation.name, absence.variable);
    }
}

TEST_F(SceneProgramsTest, ASceneWithoutGlossHasNoSpecularPassesAndTextures)
{
    LiveScene live(context(), options_, [] {});
    live.show(load_onto_device(room_));
    View special(live.shared());
    const EffectChoice own{EffectChoice::Kind::kList, {}};
    const RenderedFrame lean = draw(special, room_, own);
    View general(live.shared());
    const RenderedFrame full = draw(general, room_, kGeneral);
    const auto bytes = [](const RenderedFrame& frame) {
        std::size_t sum = 0;
        for (const auto& [name, size] : frame.memory)
            sum += size;
        return sum;
    };
    EXPECT_LT(bytes(lean), bytes(full));
    const auto speaks_of_gloss = [](const RenderedFrame& frame) {
        for (const auto& [name, size] : frame.memory)
            if (name.find("specular") != std::string::npos
                || name.find("reflectance") != std::string::npos)
                return true;
        return false;
    };
    EXPECT_FALSE(speaks_of_gloss(lean));
    EXPECT_TRUE(speaks_of_gloss(full));
    EXPECT_LE(lean.pass_times.size(), full.pass_times.size());
}

}  // namespace
}  // namespace farlight
