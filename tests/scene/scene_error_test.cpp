// Every way a Farlight scene can be wrong, and what the error says: where, found, expected.
#include "lab/temp_folder.h"
#include "tests/scene/bad_scene.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using Json = nlohmann::json;

TEST(SceneErrors, TheGoodSceneIsGood)
{
    EXPECT_EQ(refusal_of(kGood), "loaded");
}

class BadSceneTest : public testing::TestWithParam<BadScene> { };

TEST_P(BadSceneTest, SaysWhereAndWhy)
{
    EXPECT_EQ(refusal_of_patch(GetParam().patch), GetParam().error);
}

const char* const kMaterials = "one of white";
const char* const kPoint = "three numbers [x, y, z], at most 1e11 in magnitude";

std::string object(const std::string& shape)
{
    return R"({"objects": [{"material": "white", )" + shape + "}]}";
}

INSTANTIATE_TEST_SUITE_P(Document, BadSceneTest,
    testing::Values(
        BadScene{"NoVersion", R"({"version": null})",
            "found no key \"version\", expected a Farlight scene: an object with version, "
            "materials, objects, camera, ... World space is right-handed, y up by convention; "
            "lengths in scene units; radiance and reflectance in linear RGB (Rec. 709)."},
        BadScene{"NewerVersion", R"({"version": 2})",
            "/version: found 2, expected the version of this format: 1"},
        BadScene{"UnknownKey", R"({"colour": 1})",
            "/colour: found the unknown key \"colour\", expected one of $schema, background, "
            "camera, camera_paths, description, environment, fog, lights, materials, meshes, name, "
            "objects, settings, timeline, version"},
        BadScene{"KeyWithASlash", R"({"a/b~c": 1})",
            "/a~1b~0c: found the unknown key \"a/b~c\", expected one of $schema, background, "
            "camera, camera_paths, description, environment, fog, lights, materials, meshes, name, "
            "objects, settings, timeline, version"},
        BadScene{"NoObjects", R"({"objects": []})",
            "/objects: found an empty array, expected an array of at least one object, or an "
            "object with one by each name"},
        BadScene{"NegativeBackground", R"({"background": [0, -1, 0]})",
            "/background: found [0,-1,0], expected three numbers [r, g, b] from 0 to 1e18"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(Materials, BadSceneTest,
    testing::Values(
        BadScene{"AlbedoAboveOne", R"({"materials": {"white": {"albedo": [0.5, 1.5, 0.5]}}})",
            "/materials/white/albedo: found [0.5,1.5,0.5], expected three numbers [r, g, b] "
            "from 0 to 1"},
        BadScene{"AlbedoNegative", R"({"materials": {"white": {"albedo": [-0.1, 0, 0]}}})",
            "/materials/white/albedo: found [-0.1,0,0], expected three numbers [r, g, b] from 0 "
            "to 1"},
        BadScene{"EmissionNegative", R"({"materials": {"white": {"emission": [0, 0, -1]}}})",
            "/materials/white/emission: found [0,0,-1], expected three numbers [r, g, b] from 0 "
            "to 1e18"},
        BadScene{"EmissionBeyondFloat", R"({"materials": {"white": {"emission": [1e300, 0, 0]}}})",
            "/materials/white/emission: found [1e+300,0,0], expected three numbers [r, g, b] "
            "from 0 to 1e18"},
        BadScene{"TwoChannels", R"({"materials": {"white": {"albedo": [0, 0]}}})",
            "/materials/white/albedo: found [0,0], expected three numbers [r, g, b] from 0 to 1"},
        BadScene{"NotABoolean", R"({"materials": {"white": {"emits_both_sides": "yes"}}})",
            "/materials/white/emits_both_sides: found \"yes\", expected true or false"},
        BadScene{"UnknownProperty", R"({"materials": {"white": {"texture": {"tint": 1}}}})",
            "/materials/white/texture: found the unknown key \"texture\", expected one of "
            "absorption, albedo, albedo_texture, alpha_cutoff, alpha_mode, clearcoat, "
            "clearcoat_normal_scale, clearcoat_normal_texture, clearcoat_roughness, "
            "clearcoat_roughness_texture, clearcoat_texture, emission, emission_texture, "
            "emits_both_sides, ior, metallic, "
            "metallic_roughness_texture, normal_scale, normal_texture, opacity, priority, "
            "roughness, specular, specular_color, specular_color_texture, specular_texture, "
            "thin_walled, transmission, transmission_texture, unlit"},
        BadScene{"RoughnessAboveOne", R"({"materials": {"white": {"roughness": 1.5}}})",
            "/materials/white/roughness: found 1.5, expected a number from 0 to 1"},
        BadScene{"IorBelowVacuum", R"({"materials": {"white": {"ior": 0.9}}})",
            "/materials/white/ior: found 0.9, expected an index of refraction from 1 to 100"},
        BadScene{"UnknownAlphaMode", R"({"materials": {"white": {"alpha_mode": "MASK"}}})",
            "/materials/white/alpha_mode: found \"MASK\", expected opaque, mask or blend; without "
            "it blend if opacity is given, else opaque"},
        BadScene{"MissingPicture",
            R"({"materials": {"white": {"albedo_texture": {"file": "none.png"}}}})",
            "/materials/white/albedo_texture/file: found \"none.png\", and no such file, expected "
            "a PNG or JPEG picture"},
        BadScene{"UnknownWrap",
            R"({"materials": {"white": {"albedo_texture": {"file": "a.png", "wrap": "tile"}}}})",
            "/materials/white/albedo_texture/wrap: found \"tile\", expected repeat, mirror or "
            "clamp, or two of them for u and v"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(Camera, BadSceneTest,
    testing::Values(
        BadScene{"OnItsTarget", R"({"camera": {"target": [0, 0, 5]}})",
            "/camera/target: found a camera that stands on its target, expected a target away "
            "from position"},
        BadScene{"NoUp", R"({"camera": {"up": [0, 0, 0]}})",
            "/camera/up: found [0,0,0], expected a direction: not all three 0"},
        BadScene{"FovZero", R"({"camera": {"vertical_fov_degrees": 0}})",
            "/camera/vertical_fov_degrees: found 0, expected an angle from 0.001 to 179 degrees"},
        BadScene{"FovStraight", R"({"camera": {"vertical_fov_degrees": 180}})",
            "/camera/vertical_fov_degrees: found 180, expected an angle from 0.001 to 179 "
            "degrees"},
        BadScene{"NoPosition", R"({"camera": {"position": null}})",
            "/camera: found no key \"position\", expected a camera: an object with position, "
            "target, up, vertical_fov_degrees, lens_radius, focus_distance"},
        BadScene{"LensNegative", R"({"camera": {"lens_radius": -1}})",
            "/camera/lens_radius: found -1, expected a number from 0 to 1e11"},
        BadScene{"KeyframesTurnBack",
            R"({"camera_paths": {"walk": [{"frame": 0}, {"frame": 5}, {"frame": 5}]}})",
            "/camera_paths/walk/2/frame: found frame 5, expected more than the keyframe before, "
            "5"},
        BadScene{"KeyframeOnTarget",
            R"({"camera_paths": {"walk": [{"frame": 0, "position": [0, 0, 0]}]}})",
            "/camera_paths/walk/0/position: found a camera that stands on its target, expected a "
            "target away from position"},
        BadScene{"EmptyPath", R"({"camera_paths": {"walk": []}})",
            "/camera_paths/walk: found an empty array, expected an array of at least one "
            "keyframe"}),
    [](const auto& row) { return row.param.name; });

struct BadObject {
    const char* name;
    const char* shape;
    std::string error;
};
void PrintTo(const BadObject& bad, std::ostream* out)
{
    *out << bad.shape;
}

class BadObjectTest : public testing::TestWithParam<BadObject> { };

TEST_P(BadObjectTest, SaysWhereAndWhy)
{
    Json scene = Json::parse(kGood);
    scene.merge_patch(Json::parse(object(GetParam().shape)));
    EXPECT_EQ(refusal_of(scene.dump()), "/objects/0" + GetParam().error);
}

const std::string kOneShape =
    ": found an object, expected an object with exactly one of sphere, disk, quad, box, mesh, and "
    "the name of its material (a mesh file may bring its own)";
const std::string kOneBox =
    "/box: found an object, expected a box: an object with either center and size (and "
    "rotation_degrees) or lower and upper";
const std::string kRadius = "expected a number greater than 0 and at most 1e11";

INSTANTIATE_TEST_SUITE_P(Shapes, BadObjectTest,
    testing::Values(BadObject{"NoShape", R"("name": "a")", kOneShape},
        BadObject{"TwoShapes",
            R"("sphere": {"center": [0,0,0], "radius": 1}, "box": {"lower": [0,0,0], "upper": [1,1,1]})",
            kOneShape},
        BadObject{"UnknownMaterial",
            R"("material": "gold", "sphere": {"center": [0,0,0], "radius": 1})",
            std::string("/material: found the unknown material \"gold\", expected ") + kMaterials},
        BadObject{"RadiusZero", R"("sphere": {"center": [0,0,0], "radius": 0})",
            "/sphere/radius: found 0, " + kRadius},
        BadObject{"RadiusNegative", R"("sphere": {"center": [0,0,0], "radius": -1})",
            "/sphere/radius: found -1, " + kRadius},
        BadObject{"RadiusText", R"("sphere": {"center": [0,0,0], "radius": "big"})",
            "/sphere/radius: found \"big\", " + kRadius},
        BadObject{"CenterTooFar", R"("sphere": {"center": [0,2e11,0], "radius": 1})",
            std::string("/sphere/center: found [0,200000000000.0,0], expected ") + kPoint},
        BadObject{"QuadOfNoArea",
            R"("quad": {"corner": [0,0,0], "edge_u": [1,1,0], "edge_v": [2,2,0]})",
            "/quad: found a quad of no area: edge_u [1,1,0], edge_v [2,2,0], expected edges that "
            "are not 0 and not parallel"},
        BadObject{"DiskWithoutNormal",
            R"("disk": {"center": [0,0,0], "normal": [0,0,0], "radius": 1})",
            "/disk/normal: found [0,0,0], expected a direction: not all three 0"},
        BadObject{"QuadOfNoEdge",
            R"("quad": {"corner": [0,0,0], "edge_u": [0,0,0], "edge_v": [2,2,0]})",
            "/quad: found a quad of no area: edge_u [0,0,0], edge_v [2,2,0], expected edges that "
            "are not 0 and not parallel"},
        BadObject{"FlatBox", R"("box": {"center": [0,0,0], "size": [1,0,1]})",
            "/box/size: found [1,0,1], expected three numbers [x, y, z], greater than 0 and at "
            "most 1e11"},
        BadObject{"BoxBothWays", R"("box": {"center": [0,0,0], "size": [1,1,1], "lower": [0,0,0]})",
            kOneBox},
        BadObject{"BoxInsideOut", R"("box": {"lower": [0,0,0], "upper": [1,-1,1]})",
            "/box/upper: found [1,-1,1], expected more than lower [0,0,0] on each axis"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(Meshes, BadObjectTest,
    testing::Values(
        BadObject{"IndexOutOfRange",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2],[0,1,3]]})",
            "/mesh/triangles/1/2: found index 3, expected less than 3, the number of positions"},
        BadObject{"IndexNegative",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,-2]]})",
            "/mesh/triangles/0: found [0,1,-2], expected three indices into positions, each an "
            "integer from 0"},
        BadObject{"IndexNotWhole",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,0.5]]})",
            "/mesh/triangles/0: found [0,1,0.5], expected three indices into positions, each an "
            "integer from 0"},
        BadObject{"NoTriangles",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "triangles": []})",
            "/mesh/triangles: found an empty array, expected at least one triangle"},
        BadObject{"NothingLeft",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[2,0,0]], "triangles": [[0,1,2]]})",
            "/mesh/triangles: found no triangle that has an area, expected at least one"},
        BadObject{"TooFewNormals",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "normals": [[0,0,1]], "triangles": [[0,1,2]]})",
            "/mesh/normals: found 1 normals, expected 3, one a position"},
        BadObject{"TooManyUvs",
            R"("mesh": {"positions": [[0,0,0],[1,0,0],[0,1,0]], "uvs": [[0,0],[1,0],[0,1],[1,1]], "triangles": [[0,1,2]]})",
            "/mesh/uvs: found 4 uvs, expected 3, one a position"},
        BadObject{"UnknownSharedMesh", R"("mesh": {"instance_of": "knot"})",
            "/mesh/instance_of: found the unknown mesh \"knot\", expected one of /meshes, which "
            "has none"},
        BadObject{"MaterialsOfAShape",
            R"("materials": {"a": "white"}, "sphere": {"center": [0,0,0], "radius": 1})",
            "/materials: found materials for a shape that has one, expected a mesh of a file"},
        BadObject{"MissingFile", R"("mesh": {"file": "nowhere.glb"})",
            "/mesh/file: found \"nowhere.glb\", and no such file, expected a .gltf or .glb file"},
        BadObject{"WrongFile", R"("mesh": {"file": "picture.png"})",
            "/mesh/file: found \"picture.png\", expected the path of a .gltf or .glb file"}),
    [](const auto& row) { return row.param.name; });

TEST(SceneErrors, AnObjectNeedsAMaterialUnlessItsFileBringsOne)
{
    EXPECT_EQ(
        refusal_of(R"({"version": 1, "objects": [{"sphere": {"center": [0,0,0], "radius": 1}}]})"),
        "/objects/0: found no key \"material\", expected the name of one of /materials");
}

TEST(SceneErrors, CoordinatesThatAddUpBeyondTheLimit)
{
    Json scene = Json::parse(kGood);
    scene["objects"][0]["sphere"] = {{"center", {9e10, 0, 0}}, {"radius", 2e10}};
    EXPECT_EQ(refusal_of(scene.dump()),
        "found objects beyond 1e11 in world space, expected coordinates of at most 1e11 in "
        "magnitude");
}

struct BadText {
    const char* name;
    const char* text;
    const char* error;
};
void PrintTo(const BadText& bad, std::ostream* out)
{
    *out << bad.text;
}

class BadTextTest : public testing::TestWithParam<BadText> { };

TEST_P(BadTextTest, SaysLineColumnAndPointer)
{
    EXPECT_EQ(refusal_of(GetParam().text), GetParam().error);
}

INSTANTIATE_TEST_SUITE_P(Syntax, BadTextTest,
    testing::Values(BadText{"Nothing", "", "found an empty text, expected a scene"},
        BadText{"NotJson", "hello",
            "line 1, column 1: found broken JSON while parsing value - invalid literal; last "
            "read: 'h', expected valid JSON"},
        BadText{"MissingValue", "{\n  \"camera\": {\n    \"position\": }\n}",
            "/camera/position at line 3, column 17: found broken JSON while parsing value - "
            "unexpected '}', expected '[', '{', or a literal"},
        BadText{"Overflow", R"({"objects": [{}, {"sphere": {"radius": 1e999}}]})",
            "/objects/1/sphere/radius at line 1, column 44: found the number 1e999, expected a "
            "finite number"},
        BadText{"NotANumber", R"({"objects": [{"sphere": {"radius": NaN}}]})",
            "/objects/0/sphere/radius at line 1, column 36: found broken JSON while parsing "
            "value - invalid literal; last read: '\"radius\": N', expected valid JSON"},
        BadText{"Unfinished", R"({"version": 1)",
            "/version at line 1, column 13: found broken JSON while parsing object - unexpected "
            "end of input, expected '}'"},
        BadText{"SameKeyTwice", R"({"version": 1, "camera": {"up": 1, "up": 2}})",
            "/camera/up: found the key \"up\" a second time, expected each key once"},
        BadText{"NotAnObject", "[1, 2]",
            "found [1,2], expected a Farlight scene: an object with version, materials, objects, "
            "camera, ... World space is right-handed, y up by convention; lengths in scene units; "
            "radiance and reflectance in linear RGB (Rec. 709)."}),
    [](const auto& row) { return row.param.name; });

TEST(SceneErrors, EndlessNestingIsRefusedAndDoesNotOverflowTheStack)
{
    EXPECT_THAT(refusal_of(std::string(1000000, '[')),
        testing::EndsWith("found deeper nesting, expected at most 100 levels"));
}

TEST(SceneErrors, Files)
{
    const TempFolder folder;
    const auto refusal_for = [](const std::filesystem::path& file) {
        return refusal(file.string(), [&] { load_scene(file); });
    };
    EXPECT_EQ(refusal_for(folder.path() / "none.json"), "found no such file, expected a file");
    EXPECT_EQ(refusal_for(folder.path() / "none.glb"), "found no such file, expected a file");
    EXPECT_EQ(refusal_for(folder.path()), "found a folder, expected a file");
    EXPECT_EQ(refusal_for(folder.write("empty.json", "")), "found an empty file, expected a scene");
    EXPECT_EQ(refusal_for(folder.write("scene.txt", kGood)),
        "found the extension \".txt\", expected a .json, .gltf or .glb file");
    EXPECT_EQ(refusal_for(folder.write("scene.json", kGood)), "loaded");
}

}  // namespace
}  // namespace farlight
