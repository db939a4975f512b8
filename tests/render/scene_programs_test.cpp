// Which programs draw a scene, and that changing them, or the scene, between frames costs nobody
// anything but what it must.
#include "lab/meshes.h"
#include "lab/moved.h"
#include "server/render/live_scene.h"
#include "tests/scene/plain_scene.h"
#include "tests/support/gl_test.h"

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

int needed_room(const GpuScene& gpu, const std::string& name)
{
    for (const auto& [define, value] : gpu.defines())
        if (define == name)
            return std::stoi(value);
    return 0;
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

/// Of a scene far away, whose positions are counted from elsewhere after the edit.
TEST_F(SceneProgramsTest, AnEditThatMovesTheOriginCostsNoHistory)
{
    const Scene far = lab::moved(room_, {1e6, -2e6, 64});
    Scene edited = far;
    edited.camera.target += glm::dvec3(1.5, 1.5, 1.5);
    edited.camera.position = edited.camera.target + glm::dvec3(0.01, 0, 0);
    LiveScene live(context(), options_, [] {});
    View view(live.shared());
    RenderRequest request = linear_request(far, {32, 24}, {});
    request.settings.view = DebugView::kHistoryLength;
    glm::dvec3 origin(0);
    for (int frame = 1; frame <= 6; ++frame) {
        request.camera.position.x += 0.03125;
        if (frame == 1 || frame == 4)
            live.show(load_onto_device(frame == 1 ? far : edited));
        const RenderedFrame drawn = view.render(request);
        EXPECT_EQ(drawn.history_reset, frame == 1);
        EXPECT_EQ(pixel(drawn.image, 16, 12).x, static_cast<float>(frame));
        EXPECT_NE(live.shared().look.origin, glm::dvec3(0));
        EXPECT_TRUE(frame != 4 || live.shared().look.origin != origin) << "nothing is tested";
        origin = live.shared().look.origin;
    }
}

/// The same effects, but a deeper tree, or another array of textures.
TEST_F(SceneProgramsTest, AnEditThatNeedsMoreRoomIsNotDrawnInLess)
{
    Scene painted = room_;
    Material& paint = painted.materials[0];
    paint.metallic = paint.roughness = 0.5F;
    paint.albedo_texture = texture_of(painted, {kBlack, kWhite});
    Scene deeper = painted;
    deeper.meshes[0] = bumpy_sphere(120, 60);
    Scene measured = painted;
    measured.materials[0].metallic_roughness_texture = texture_of(measured, {kBlack, kTilted});

    LiveScene live(context(), options_, [] {});
    View view(live.shared());
    const auto show = [&](const Scene& scene) {
        live.show(load_onto_device(scene));
        return draw(view, scene);
    };
    for (const Scene* more : {&deeper, &measured}) {
        show(painted);
        live.finish_programs();
        const RenderedFrame small = draw(view, painted);
        ASSERT_EQ(small.effects, mask_of(live.gpu().effects()));
        const RenderedFrame large = show(*more);
        ASSERT_EQ(mask_of(live.gpu().effects()), small.effects) << "another effect, mend the test";
        bool needs_more = false;
        for (std::size_t i = 0; i < small.constants.size(); ++i) {
            const auto& [name, room] = large.constants[i];
            const int needed = needed_room(live.gpu(), name);
            EXPECT_GE(room, needed) << name;
            needs_more = needs_more || needed > small.constants[i].second;
        }
        EXPECT_TRUE(needs_more) << "nothing is tested";
    }
}

/// More variants than are kept, in a scene whose own macros are the end of another variant's.
TEST_F(SceneProgramsTest, OnlyTheOldestVariantsLoseTheirPrograms)
{
    Scene ball;
    ball.materials.push_back({"white"});
    ball.objects.push_back({"ball", 0, Sphere{}});
    ProgramCache programs;
    ScenePrograms variants(programs, nullptr, nullptr, {});
    variants.follow(std::make_shared<GpuScene>(ball));
    const DeclareFrame declare = [](FrameGraph& graph, const SceneInputs& inputs) {
        graph.add_pass("cheap", "tonemap/tonemap.comp").define(inputs.defines);
    };
    const auto keys_with = [&](const std::vector<std::string_view>& effects) {
        const EffectChoice choice{EffectChoice::Kind::kList, EffectMask::of(effects)};
        auto keys = programs_of(declare, variants.choose(choice, {}, declare).inputs);
        for (const ProgramKey& key : keys)
            programs.get(key);
        return keys;
    };
    const auto has = [&](const std::vector<ProgramKey>& keys) {
        return std::all_of(
            keys.begin(), keys.end(), [&](const ProgramKey& key) { return programs.has(key); });
    };
    std::vector<std::vector<ProgramKey>> kept;
    for (const char* effect :
        {"spheres", "triangles", "disks", "mirror", "clearcoat", "unlit", "alpha", "fog"})
        kept.push_back(keys_with({effect}));
    ASSERT_EQ(kept.size(), kMostVariants);
    const auto general = keys_with(EffectMask::general().names());
    for (const auto& keys : kept)
        EXPECT_TRUE(has(keys)) << "as many as are kept";
    keys_with({"lens"});
    EXPECT_FALSE(has(kept[0])) << "the oldest is still there";
    for (std::size_t i = 1; i < kept.size(); ++i)
        EXPECT_TRUE(has(kept[i])) << i;
    keys_with({"triangles"});
    keys_with({"textures"});
    EXPECT_TRUE(has(kept[1])) << "chosen again";
    EXPECT_FALSE(has(kept[2]));
    for (const char* effect : {"lights", "background", "motion", "instances", "light_tree"})
        keys_with({effect});
    EXPECT_TRUE(has(general));
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
