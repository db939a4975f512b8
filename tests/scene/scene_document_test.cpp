// Documents and their edits.
#include "server/scene/scene_document.h"

#include "lab/temp_folder.h"
#include "server/scene/gltf_file.h"
#include "server/scene/scene_defaults.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/png.h"
#include "tests/scene/refusal.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace farlight {
namespace {

using Json = nlohmann::json;

class SceneDocumentTest : public testing::Test {
protected:
    SceneDocumentTest()
    {
        folder_.write("a.png", png8(1, 1, {9, 9, 9, 9}));
        triangle_gltf().write_glb(folder_.path() / "part.glb");
    }

    SceneDocument load(const char* text) const
    {
        return SceneDocument::load(folder_.write("scene.json", text));
    }
    std::string refusal_of(const SceneDocument& document, const char* patch) const
    {
        return refusal(
            (folder_.path() / "scene.json").string(), [&] { document.edited(Json::parse(patch)); });
    }

    TempFolder folder_;
};

const char* const kScene = R"({"version": 1,
    "materials": {"m": {"albedo_texture": {"file": "a.png"}}, "spare": {}},
    "objects": {"ball": {"material": "m", "sphere": {"center": [0, 0, 0], "radius": 1}},
                "part": {"mesh": {"file": "part.glb"}}}})";

TEST_F(SceneDocumentTest, EditsMergeAndLeaveTheOriginalAlone)
{
    const SceneDocument before = load(kScene);
    const Json document = before.document();
    const SceneDocument after = before.edited(Json::parse(R"({
        "fog": {"scattering": [1, 2, 3]}, "background": [1, 1, 1],
        "objects": {"ball": {"sphere": {"radius": 2}}, "part": null},
        "materials": {"m": {"roughness": 0.5}}})"));
    EXPECT_EQ(after.scene().medium.sigma_s, glm::vec3(1, 2, 3));
    ASSERT_EQ(after.scene().objects.size(), 1U);
    EXPECT_EQ(std::get<Sphere>(after.scene().objects[0].shape).radius, 2);
    EXPECT_EQ(after.scene().materials[0].roughness, 0.5F);
    EXPECT_TRUE(after.scene().materials[0].albedo_texture.used());
    EXPECT_EQ(before.document(), document);
    EXPECT_EQ(before.scene().objects.size(), 2U);
    EXPECT_EQ(before.scene().medium, Medium{});
    EXPECT_EQ(after.edited({{"fog", nullptr}}).scene().medium, Medium{});
}

TEST_F(SceneDocumentTest, ARefusedEditSaysWhere)
{
    const SceneDocument document = load(kScene);
    EXPECT_EQ(refusal_of(document, R"({"objects": {"ball": {"sphere": {"radius": -1}}}})"),
        "/objects/ball/sphere/radius: found -1, expected a number greater than 0 and at most 1e11");
    EXPECT_EQ(refusal_of(document, R"({"materials": {"m": null}})"),
        "/objects/ball/material: found the unknown material \"m\", expected one of spare");
    EXPECT_EQ(refusal_of(document, R"({"objects": {"ball": null, "part": null}})"),
        "/objects: found an empty object, expected an array of at least one object, or an object "
        "with one by each name");
    EXPECT_EQ(refusal_of(document, "{}"), "loaded");
}

TEST_F(SceneDocumentTest, EditsRereadNoFile)
{
    const SceneDocument document = load(kScene);
    std::filesystem::remove(folder_.path() / "part.glb");
    std::filesystem::remove(folder_.path() / "a.png");
    const SceneDocument edited = document.edited({{"background", {1, 1, 1}}});
    EXPECT_EQ(edited.scene().images.size(), 1U);
    EXPECT_EQ(edited.scene().meshes.size(), 1U);
}

TEST_F(SceneDocumentTest, EditsReachNoFileOutsideTheScenesFolder)
{
    const SceneDocument document = load(kScene);
    EXPECT_EQ(refusal_of(document, R"({"environment": {"file": "../sky.hdr"}})"),
        "/environment/file: found \"../sky.hdr\", expected a file in the scene's own folder or "
        "below");
    EXPECT_EQ(refusal_of(document, R"({"objects": {"part": {"mesh": {"file": "/etc/a.glb"}}}})"),
        "/objects/part/mesh/file: found \"/etc/a.glb\", expected a file in the scene's own folder "
        "or below");
    folder_.write("b.png", png8(1, 1, {1, 1, 1, 1}));
    EXPECT_EQ(
        refusal_of(document, R"({"materials": {"m": {"albedo_texture": {"file": "b.png"}}}})"),
        "loaded");
}

void expect_equal(const Scene& a, const Scene& b)
{
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(a.materials, b.materials);
    EXPECT_EQ(a.background, b.background);
    EXPECT_EQ(a.camera, b.camera);
    EXPECT_EQ(a.camera_paths.size(), b.camera_paths.size());
    EXPECT_EQ(a.notes, b.notes);
    EXPECT_EQ(a.lights.size(), b.lights.size());
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t i = 0; i < a.meshes.size(); ++i)
        EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions) << i;
    ASSERT_EQ(a.images.size(), b.images.size());
    for (std::size_t i = 0; i < a.images.size(); ++i)
        EXPECT_EQ(a.images[i].texels, b.images[i].texels) << i;
    ASSERT_EQ(a.objects.size(), b.objects.size());
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        EXPECT_EQ(a.objects[i].name, b.objects[i].name);
        EXPECT_EQ(a.objects[i].material, b.objects[i].material);
        EXPECT_EQ(a.objects[i].node, b.objects[i].node);
        const auto* x = std::get_if<MeshInstance>(&a.objects[i].shape);
        const auto* y = std::get_if<MeshInstance>(&b.objects[i].shape);
        ASSERT_EQ(x == nullptr, y == nullptr);
        if (x != nullptr) {
            EXPECT_EQ(x->mesh, y->mesh);
            EXPECT_EQ(x->world_from_object, y->world_from_object);
            EXPECT_EQ(x->skin, y->skin);
        }
    }
    ASSERT_EQ(a.animation.nodes.size(), b.animation.nodes.size());
    for (std::size_t i = 0; i < a.animation.nodes.size(); ++i) {
        EXPECT_EQ(a.animation.nodes[i].parent, b.animation.nodes[i].parent);
        EXPECT_EQ(a.animation.nodes[i].local, b.animation.nodes[i].local);
    }
    ASSERT_EQ(a.animation.tracks.size(), b.animation.tracks.size());
    for (std::size_t i = 0; i < a.animation.tracks.size(); ++i)
        EXPECT_EQ(a.animation.tracks[i].index, b.animation.tracks[i].index);
}

TEST_F(SceneDocumentTest, AWrappedGltfIsTheGltf)
{
    GltfBuilder gltf = triangle_gltf();
    gltf.document["nodes"][0]["translation"] = {1, 2, 3};
    gltf.document["nodes"][0]["rotation"] = {0, 0.6, 0, 0.8};
    gltf.document["materials"] = {{{"name", "blue"}}, {{"name", "unused"}}};
    gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
    gltf.write_glb(folder_.path() / "model.glb");
    const auto scenes = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";
    for (const auto& file : {folder_.path() / "model.glb", scenes / "trefoil_knot.glb",
             scenes / "bending_arm.glb", scenes / "squashed_ball.glb"}) {
        GltfScene expected = load_gltf(file);
        if (!expected.has_camera)
            add_framing_camera(expected.scene);
        add_default_light(expected.scene);
        const SceneDocument document = SceneDocument::load(file);
        SCOPED_TRACE(file.string());
        expect_equal(document.scene(), expected.scene);
        EXPECT_EQ(document.document(),
            Json(
                {{"version", 1}, {"objects", {{{"mesh", {{"file", file.filename().string()}}}}}}}));
    }
}

TEST_F(SceneDocumentTest, AWrappedGltfTakesEdits)
{
    const SceneDocument document = SceneDocument::load(folder_.path() / "part.glb");
    EXPECT_EQ(document.scene().objects.size(), 2U);  // and the default lamp
    const SceneDocument lit =
        document.edited(Json::parse(R"({"materials": {"red": {"albedo": [1, 0, 0]}},
        "lights": {"sun": {"intensity": [1, 1, 1], "directional": {"direction": [0, -1, 0]}}},
        "objects": [{"material": "red", "mesh": {"file": "part.glb"}}]})"));
    ASSERT_EQ(lit.scene().objects.size(), 1U);
    EXPECT_EQ(lit.scene().materials[lit.scene().objects[0].material].name, "red");
    EXPECT_EQ(lit.scene().lights.size(), 1U);
}

}  // namespace
}  // namespace farlight
