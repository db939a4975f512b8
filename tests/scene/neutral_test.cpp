// Values that make no difference leave no trace: no effect is called for, nothing is left to drop.
#include "tests/scene/plain_scene.h"

#include <functional>
#include <gmock/gmock.h>

namespace farlight {
namespace {

struct NeutralCase {
    const char* what;
    std::function<void(Scene&)> change;
};

std::vector<NeutralCase> neutral_cases()
{
    return {
        {"fog without cross section",
            [](Scene& s) {
                s.medium = {"clear", {}, {}, 0.9F};
            }},
        {"lens without aperture", [](Scene& s) { s.lens.focus_distance = 3; }},
        {"blend with opacity 1", [](Scene& s) { s.materials[0].alpha_mode = AlphaMode::kBlend; }},
        {"blend whose texels are all there",
            [](Scene& s) {
                s.materials[0].alpha_mode = AlphaMode::kBlend;
                s.materials[0].albedo_texture = texture_of(s, {kWhite, kWhite});
            }},
        {"opaque, whatever its texels and opacity say",
            [](Scene& s) {
                s.materials[0].opacity = 0.5F;
                s.materials[0].albedo_texture = texture_of(s, {{255, 255, 255, 0}, kWhite});
            }},
        {"mask whose texels all pass",
            [](Scene& s) {
                s.materials[0].alpha_mode = AlphaMode::kMask;
                s.materials[0].albedo_texture = texture_of(s, {{255, 255, 255, 128}, kWhite});
            }},
        {"black environment",
            [](Scene& s) {
                s.environment = std::make_shared<EnvironmentMap>(
                    EnvironmentMap{"sky.hdr", 2, 1, {glm::vec3(0), glm::vec3(0)}});
                s.background = glm::vec3(1);
            }},
        {"map on a black background",
            [](Scene& s) {
                s.environment = std::make_shared<EnvironmentMap>(
                    EnvironmentMap{"sky.hdr", 2, 1, {glm::vec3(1), glm::vec3(2)}});
            }},
        {"flat normal map",
            [](Scene& s) {
                s.materials[0].normal_texture = texture_of(s, {kFlat, {127, 128, 254, 255}});
            }},
        {"normal map of scale 0",
            [](Scene& s) {
                s.materials[0].normal_texture = texture_of(s, {kFlat, kTilted});
                s.materials[0].normal_scale = 0;
            }},
        {"texture of one colour",
            [](Scene& s) {
                s.materials[0].albedo_texture = texture_of(s, {kBlack, kBlack});
            }},
        {"emission map of nothing",
            [](Scene& s) {
                s.materials[0].emission_texture = texture_of(s, {kBlack, kWhite});
            }},
        {"emission times black",
            [](Scene& s) {
                s.materials[0].emission = glm::vec3(5);
                s.materials[0].emission_texture = texture_of(s, {kBlack, kBlack});
            }},
        {"unused material",
            [](Scene& s) {
                s.materials[1] = {.name = "spare", .emission = glm::vec3(1), .metallic = 1};
                s.materials[1].normal_texture = texture_of(s, {kFlat, kTilted});
            }},
        {"unused mesh",
            [](Scene& s) {
                s.meshes.push_back(s.meshes[0]);
                s.meshes[1].normals.assign(3, glm::vec3(0, 0, 1));
                s.meshes[1].colors.assign(3, glm::vec4(0.5F));
            }},
        {"unused image",
            [](Scene& s) {
                add_image(s, {kBlack, kWhite});
            }},
        {"white vertex colours", [](Scene& s) { s.meshes[0].colors.assign(3, glm::vec4(1)); }},
        {"light of no power",
            [](Scene& s) { s.lights.push_back({.name = "off", .intensity = glm::vec3(0)}); }},
        {"light that a track keeps off",
            [](Scene& s) {
                s.lights.push_back({.name = "off"});
                Track track;
                track.target = Track::Target::kLightIntensity;
                track.times = {0, 1};
                track.values = {0, 0};
                s.animation.tracks.push_back(track);
            }},
        {"track on a light of no power",
            [](Scene& s) {
                s.lights.push_back({.name = "off", .intensity = glm::vec3(0)});
                Track track;
                track.target = Track::Target::kLightIntensity;
                track.times = {0, 1};
                track.values = {0, 1};
                s.animation.tracks.push_back(track);
            }},
        {"track that moves nothing",
            [](Scene& s) {
                s.animation.tracks.push_back(moving_track());
                s.animation.tracks[0].values = {1, 2, 3, 1, 2, 3};
            }},
        {"morph targets at rest",
            [](Scene& s) {
                s.meshes[0].morph_targets = {{{{0, 0, 1}, {0, 0, 0}, {0, 0, 0}}, {}}};
                std::get<MeshInstance>(s.objects[0].shape).morph_weights = {0.5F};
            }},
        {"track on a skin's own node",
            [](Scene& s) {
                s.meshes[0].joints.assign(3, {});
                s.meshes[0].weights.assign(3, {1, 0, 0, 0});
                s.animation.nodes.push_back({.name = "bone"});
                s.animation.skins.push_back({{1}, {glm::dmat4(1)}});
                std::get<MeshInstance>(s.objects[0].shape).skin = 0;
                s.animation.tracks.push_back(moving_track());
            }},
        {"object without extent",
            [](Scene& s) {
                Material gold{.name = "gold", .metallic = 1, .roughness = 0.2F};
                s.materials[1] = gold;
                s.meshes.push_back(s.meshes[0]);
                s.meshes[1].positions[2] = s.meshes[1].positions[1];
                s.objects.push_back(
                    {.name = "thread", .material = 1, .shape = MeshInstance{.mesh = 1}});
            }},
        {"clearcoat 0",
            [](Scene& s) {
                s.materials[0].clearcoat_roughness = 0.5F;
                s.materials[0].clearcoat_normal_texture = texture_of(s, {kFlat, kTilted});
            }},
        {"glass times 0",
            [](Scene& s) {
                s.materials[0].transmission = 1;
                s.materials[0].transmission_texture = texture_of(s, {kBlack, kBlack});
            }},
    };
}

TEST(Neutral, NeutralValuesLeaveEveryBitClear)
{
    const EffectMask expected = mask_of_scene(plain());
    for (const NeutralCase& neutral : neutral_cases()) {
        Scene scene = plain();
        neutral.change(scene);
        EXPECT_THAT(mask_of_scene(scene).names(), testing::ElementsAreArray(expected.names()))
            << neutral.what;
    }
}

TEST(Neutral, DroppingTheNeutralTwiceChangesNothingMore)
{
    for (const NeutralCase& neutral : neutral_cases()) {
        Scene scene = plain();
        neutral.change(scene);
        drop_neutral(scene);
        const Scene once = scene;
        drop_neutral(scene);
        EXPECT_EQ(scene.materials, once.materials) << neutral.what;
        EXPECT_EQ(scene.background, once.background) << neutral.what;
        EXPECT_EQ(scene.animation.tracks.size(), once.animation.tracks.size()) << neutral.what;
    }
}

TEST(Neutral, UniformTexturesAreFoldedIntoTheirConstants)
{
    Scene scene = plain();
    Material& m = scene.materials[0];
    m.albedo = glm::vec3(0.5F);
    m.metallic = 0.5F;
    m.roughness = 0.5F;
    m.albedo_texture = texture_of(scene, {{255, 0, 255, 255}, {255, 0, 255, 255}});
    m.metallic_roughness_texture = texture_of(scene, {{9, 51, 255, 255}, {9, 51, 255, 255}});
    drop_neutral(scene);
    EXPECT_EQ(scene.materials[0].albedo, glm::vec3(0.5F, 0, 0.5F));
    EXPECT_FLOAT_EQ(scene.materials[0].roughness, 0.1F);
    EXPECT_FLOAT_EQ(scene.materials[0].metallic, 0.5F);
}

TEST(Neutral, HolesOfVertexColoursStay)
{
    for (const AlphaMode mode : {AlphaMode::kBlend, AlphaMode::kMask}) {
        Scene scene = plain();
        scene.materials[0].alpha_mode = mode;
        scene.meshes[0].colors.assign(3, glm::vec4(1));
        scene.meshes[0].colors[1].w = 0.25F;
        EXPECT_TRUE(mask_of_scene(scene).has("alpha"));
        drop_neutral(scene);
        EXPECT_EQ(scene.materials[0].alpha_mode, mode);
        scene.meshes[0].colors[1].w = 0.75F;  // passes the mask's 0.5, but still is half there
        EXPECT_EQ(mask_of_scene(scene).has("alpha"), mode == AlphaMode::kBlend);
    }
}

/// Never changing, and not what holds without the track.
Track constant_track(Track::Target target, const std::vector<float>& value)
{
    Track track;
    track.target = target;
    track.times = {0.5, 1};
    track.values = value;
    track.values.insert(track.values.end(), value.begin(), value.end());
    return track;
}

TEST(Neutral, ConstantTracksAreFoldedIntoWhatTheyDrive)
{
    using Target = Track::Target;
    Scene scene = plain();
    scene.materials[0].emission = glm::vec3(2);
    scene.lights.push_back({.name = "lamp", .intensity = glm::vec3(3)});
    scene.background = glm::vec3(0.5F);
    scene.meshes[0].morph_targets = {{{{0, 0, 2}, {0, 0, 0}, {0, 0, 0}}, {}}};
    std::get<MeshInstance>(scene.objects[0].shape).morph_weights = {0};
    scene.animation.tracks = {constant_track(Target::kTranslation, {1, 2, 3}),
        constant_track(Target::kRotation, {0, 1, 0, 0}), constant_track(Target::kScale, {2, 2, 4}),
        constant_track(Target::kMorphWeights, {0.25F}),
        constant_track(Target::kMaterialEmission, {4}),
        constant_track(Target::kLightIntensity, {5}), constant_track(Target::kBackground, {6})};
    drop_neutral(scene);
    EXPECT_TRUE(scene.animation.tracks.empty());
    const Node& node = scene.animation.nodes[0];
    EXPECT_EQ(node.translation, glm::dvec3(1, 2, 3));
    EXPECT_EQ(node.rotation, glm::dquat(0, 0, 1, 0));
    EXPECT_EQ(node.scale, glm::dvec3(2, 2, 4));
    const auto& shape = std::get<MeshInstance>(scene.objects[0].shape);
    EXPECT_EQ(scene.meshes[shape.mesh].positions[0], glm::vec3(0, 0, 0.5F));
    EXPECT_EQ(scene.materials[0].emission, glm::vec3(8));
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(15));
    EXPECT_EQ(scene.background, glm::vec3(3));
}

Scene morphing(std::uint32_t objects)
{
    Scene scene = plain();
    scene.meshes[0].morph_targets = {{{{0, 0, 2}, {0, 0, 0}, {0, 4, 0}}, {}}};
    scene.objects.resize(objects, scene.objects[0]);
    return scene;
}

MeshInstance& shape_of(Scene& scene, std::size_t object)
{
    return std::get<MeshInstance>(scene.objects[object].shape);
}

TEST(Neutral, MorphsAtRestAreInTheVerticesAndSharedByThoseOfTheSameWeights)
{
    Scene scene = morphing(4);
    shape_of(scene, 1).morph_weights = shape_of(scene, 2).morph_weights = {0.5F};
    shape_of(scene, 3).morph_weights = {0.25F};
    drop_neutral(scene);
    EXPECT_EQ(shape_of(scene, 1).mesh, shape_of(scene, 2).mesh);
    EXPECT_NE(shape_of(scene, 1).mesh, shape_of(scene, 3).mesh);
    EXPECT_TRUE(scene.meshes[0].positions.empty()) << "what nothing shows is kept";
    const std::vector<glm::vec3> none = plain().meshes[0].positions;
    const std::vector<glm::vec3> half{{0, 0, 1}, {1, 0, 0}, {0, 3, 0}};
    EXPECT_EQ(scene.meshes[shape_of(scene, 0).mesh].positions, none);
    EXPECT_EQ(scene.meshes[shape_of(scene, 1).mesh].positions, half);
    for (const Mesh& mesh : scene.meshes)
        EXPECT_TRUE(mesh.morph_targets.empty());
}

TEST(Neutral, AMorphThatATrackDrivesStays)
{
    Scene scene = morphing(2);
    shape_of(scene, 0).morph_weights = shape_of(scene, 1).morph_weights = {0.5F};
    scene.animation.tracks.push_back(moving_track());
    scene.animation.tracks[0].target = Track::Target::kMorphWeights;
    scene.animation.tracks[0].values = {0, 1};
    scene.animation.tracks[0].index = 1;
    drop_neutral(scene);
    EXPECT_EQ(shape_of(scene, 1).mesh, 0U);
    EXPECT_EQ(scene.meshes[0].morph_targets.size(), 1U);
    EXPECT_EQ(scene.meshes[shape_of(scene, 0).mesh].positions[2], glm::vec3(0, 3, 0));
    EXPECT_TRUE(mask_of_scene(scene).has("deformation"));
}

}  // namespace
}  // namespace farlight
