// What a good Farlight scene turns into.
#include "lab/temp_folder.h"
#include "server/scene/scene_file.h"
#include "tests/scene/gltf_builder.h"
#include "tests/scene/positions.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using testing::ElementsAre;

Scene parse(const std::string& objects, const std::filesystem::path& base_dir = ".")
{
    return parse_scene(R"({"version": 1, "name": "test",
            "materials": {"grey": {"albedo": [0.5, 0.25, 0.125]}, "lamp": {"emission": [1, 2, 3],
            "emits_both_sides": true}}, "camera": {"position": [0, 0, 9], "target": [0, 0, 0]},
            "objects": )"
            + objects + "}",
        base_dir, "test.json");
}

TEST(SceneJson, MaterialsKeepTheirNumbers)
{
    const Scene scene = parse(R"([
        {"name": "a", "material": "lamp", "sphere": {"center": [1, 2, 3], "radius": 4}},
        {"material": "grey", "quad": {"corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 2, 0]}}])");
    EXPECT_EQ(scene.name, "test");
    ASSERT_EQ(scene.objects.size(), 2U);
    const Material& lamp = scene.materials[scene.objects[0].material];
    EXPECT_EQ(lamp.name, "lamp");
    EXPECT_EQ(lamp.emission, glm::vec3(1, 2, 3));
    EXPECT_TRUE(lamp.emits_both_sides);
    const Material& grey = scene.materials[scene.objects[1].material];
    EXPECT_EQ(grey.albedo, glm::vec3(0.5F, 0.25F, 0.125F));
    EXPECT_EQ(grey.emission, glm::vec3(0));
    EXPECT_FALSE(grey.emits_both_sides);
    EXPECT_EQ(scene.objects[0].name, "a");
    EXPECT_EQ(scene.objects[1].name, "object 1");
    const auto& sphere = std::get<Sphere>(scene.objects[0].shape);
    EXPECT_EQ(sphere.center, glm::dvec3(1, 2, 3));
    EXPECT_EQ(sphere.radius, 4);
    EXPECT_EQ(std::get<Quad>(scene.objects[1].shape).edge_v, glm::dvec3(0, 2, 0));
    EXPECT_THAT(scene.notes, testing::IsEmpty());
}

TEST(SceneJson, BoundsCoverEveryShape)
{
    const Bounds bounds = scene_bounds(parse(R"([
        {"material": "grey", "sphere": {"center": [10, 0, 0], "radius": 2}},
        {"material": "grey", "quad": {"corner": [0, 0, 0], "edge_u": [-5, 0, 0], "edge_v": [0, 7, 0]}},
        {"material": "grey", "box": {"lower": [0, -1, -3], "upper": [1, 0, 4]}}])"));
    EXPECT_EQ(bounds.lower, glm::dvec3(-5, -2, -3));
    EXPECT_EQ(bounds.upper, glm::dvec3(12, 7, 4));
}

TEST(SceneJson, BoxesShareOneCubeWithOutwardFaces)
{
    const Scene scene = parse(R"([
        {"material": "grey", "box": {"center": [1, 2, 3], "size": [2, 4, 6]}},
        {"material": "grey", "box": {"lower": [0, 0, 0], "upper": [1, 1, 1]}}])");
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Mesh& cube = scene.meshes[0];
    EXPECT_TRUE(cube.normals.empty());
    ASSERT_EQ(cube.triangles.size(), 12U);
    for (const glm::uvec3& t : cube.triangles) {
        const glm::vec3 a = cube.positions[t.x];
        const glm::vec3 normal = glm::cross(cube.positions[t.y] - a, cube.positions[t.z] - a);
        EXPECT_GT(glm::dot(normal, a + cube.positions[t.y] + cube.positions[t.z]), 0);
    }
    expect_near(world_position(scene, 0, 0), {0, 0, 0});
    expect_near(world_position(scene, 0, 7), {2, 4, 6});
    expect_near(world_position(scene, 1, 7), {1, 1, 1});
}

TEST(SceneJson, RotationsTurnAboutXThenYThenZ)
{
    // (0.5, 0.5, 0.5) about x by 90: (0.5, -0.5, 0.5); about z by 90: (0.5, 0.5, 0.5).
    const Scene scene = parse(R"([{"material": "grey", "box":
        {"center": [0, 0, 0], "size": [2, 4, 6], "rotation_degrees": [90, 0, 90]}}])");
    // Corner (1, 2, 3): about x (1, -3, 2); about z (3, 1, 2).
    expect_near(world_position(scene, 0, 7), {3, 1, 2});
}

TEST(SceneJson, InlineMeshesAreRepairedAndSaySo)
{
    const Scene scene = parse(R"([{"material": "grey", "mesh": {
        "positions": [[9, 9, 9], [0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]],
        "normals": [[0, 0, 1], [0, 0, 2], [0, 0, 0], [0, 0, 1], [0, 0, 1]],
        "triangles": [[1, 2, 4], [1, 2, 3]], "scale": [2, 2, 2], "translation": [0, 0, 1]}}])");
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2)));
    EXPECT_EQ(mesh.positions.size(), 3U);
    EXPECT_THAT(mesh.normals, testing::Each(glm::vec3(0, 0, 1)));
    EXPECT_THAT(scene.notes,
        ElementsAre("1 triangle of zero area left out",
            "1 shading normal without a direction replaced by the faces around"));
    expect_near(world_position(scene, 0, 1), {2, 0, 1});
}

TEST(SceneJson, MeshFilesAreReadOnceAndBringTheirMaterials)
{
    const TempFolder folder;
    GltfBuilder gltf = triangle_gltf();
    gltf.document["materials"] = {
        {{"name", "blue"}, {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 1, 1}}}}}};
    gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
    gltf.write_glb(folder.path() / "part.glb");
    const Scene scene = parse(R"([
        {"name": "own", "mesh": {"file": "part.glb", "translation": [5, 0, 0]}},
        {"name": "painted", "material": "grey", "mesh": {"file": "part.glb"}}])",
        folder.path());
    EXPECT_EQ(scene.meshes.size(), 1U);
    ASSERT_EQ(scene.objects.size(), 2U);
    EXPECT_EQ(scene.objects[0].name, "own");
    EXPECT_EQ(scene.materials[scene.objects[0].material].name, "blue");
    EXPECT_EQ(scene.materials[scene.objects[1].material].name, "grey");
    expect_near(world_position(scene, 0, 0), {5, 0, 0});
    expect_near(world_position(scene, 1, 0), {0, 0, 0});
}

TEST(SceneJson, MaterialsOfAFileAreReplacedByName)
{
    const TempFolder folder;
    GltfBuilder gltf = triangle_gltf();
    gltf.document["materials"] = {{{"name", "blue"}}, {{"name", "green"}}};
    gltf.document["meshes"][0]["primitives"][0]["material"] = 1;
    gltf.write_glb(folder.path() / "part.glb");
    const auto material_with = [&](const std::string& materials) {
        const Scene scene = parse(R"([{"name": "part", "materials": )" + materials
                + R"(, "mesh": {"file": "part.glb"}}])",
            folder.path());
        return scene.materials[scene.objects.at(0).material].name;
    };
    EXPECT_EQ(material_with(R"({"green": "grey"})"), "grey");
    EXPECT_EQ(material_with(R"({"blue": "grey"})"), "green");
    EXPECT_THROW(material_with(R"({"red": "grey"})"), SceneError);
    EXPECT_THROW(material_with(R"({"green": "none"})"), SceneError);
}

TEST(SceneJson, MeshesMayBeShared)
{
    const Scene scene = parse_scene(R"({"version": 1, "materials": {"m": {}},
        "meshes": {"leaf": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 2]],
            "uvs": [[0, 0], [1, 0], [0, 1]], "uvs_1": [[0.5, 0], [1, 0], [0, 1]],
            "tangents": [[1, 0, 0, -1], [1, 0, 0, -1], [1, 0, 0, -1]],
            "colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0.5]]}},
        "objects": [{"material": "m", "mesh": {"instance_of": "leaf"}},
                    {"material": "m", "mesh": {"instance_of": "leaf", "translation": [1, 2, 3]}}]})",
        ".", "test.json");
    ASSERT_EQ(scene.meshes.size(), 1U);
    const Mesh& leaf = scene.meshes[0];
    EXPECT_THAT(leaf.uvs[0], ElementsAre(glm::vec2(0), glm::vec2(1, 0), glm::vec2(0, 1)));
    EXPECT_EQ(leaf.uvs[1][0], glm::vec2(0.5, 0));
    EXPECT_EQ(leaf.tangents[0], glm::vec4(1, 0, 0, -1));
    EXPECT_EQ(leaf.colors[2], glm::vec4(0, 0, 1, 0.5));
    expect_near(world_position(scene, 1, 0), {1, 2, 3});
}

TEST(SceneJson, TexturedBoxesHaveAnUprightPictureOnEachFace)
{
    const Scene scene = parse_scene(R"({"version": 1, "materials": {"m": {"albedo_texture":
        {"file": "letter.png"}}, "plain": {}},
        "objects": [{"material": "m", "box": {"lower": [0, 0, 0], "upper": [1, 1, 1]}},
                    {"material": "plain", "box": {"lower": [0, 0, 0], "upper": [1, 1, 1]}}]})",
        std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes", "test.json");
    ASSERT_EQ(scene.meshes.size(), 2U);
    EXPECT_TRUE(scene.meshes[1].uvs[0].empty());
    const Mesh& cube = scene.meshes[0];
    ASSERT_EQ(cube.triangles.size(), 12U);
    for (const glm::uvec3& t : cube.triangles) {
        const glm::vec3 a = cube.positions[t.x];
        const glm::vec3 u = cube.positions[t.y] - a;
        const glm::vec3 v = cube.positions[t.z] - a;
        const glm::vec3 normal = glm::cross(u, v);
        EXPECT_GT(glm::dot(normal, a + cube.positions[t.y] + cube.positions[t.z]), 0);
        // Seen from outside u runs to the right and v down, so that uv triangles turn clockwise.
        const glm::vec2 du = cube.uvs[0][t.y] - cube.uvs[0][t.x];
        const glm::vec2 dv = cube.uvs[0][t.z] - cube.uvs[0][t.x];
        EXPECT_LT(du.x * dv.y - du.y * dv.x, 0);
        if (std::abs(normal.y) > 0.5F)
            continue;
        for (int corner = 0; corner < 3; ++corner)  // v = 0 is on top of the sides
            EXPECT_EQ(cube.uvs[0][t[corner]].y, 0.5F - cube.positions[t[corner]].y);
    }
}

TEST(SceneJson, LightsFogAndLensKeepTheirNumbers)
{
    const Scene scene = parse_scene(R"({"version": 1, "materials": {"m": {}},
        "objects": {"b": {"material": "m", "disk": {"center": [1, 2, 3], "normal": [0, 0, 5], "radius": 4}},
                    "a": {"material": "m", "sphere": {"center": [0, 0, 0], "radius": 1}}},
        "fog": {"name": "haze", "absorption": [1, 2, 3], "scattering": [4, 5, 6], "g": -0.5},
        "lights": {"lamp": {"intensity": [1, 2, 3], "spot": {"position": [4, 5, 6],
                       "direction": [0, -3, 0], "inner_cone_degrees": 10, "outer_cone_degrees": 20}},
                   "bulb": {"intensity": [7, 8, 9], "point": {"position": [1, 1, 1]}},
                   "sun": {"intensity": [3, 2, 1], "directional": {"direction": [2, 0, 0]}}},
        "camera": {"position": [0, 0, 9], "target": [0, 0, 0], "lens_radius": 0.25, "focus_distance": 7}})",
        ".", "test.json");
    EXPECT_EQ(scene.objects[0].name, "a");  // objects by name come in the order of their names
    EXPECT_EQ(std::get<Disk>(scene.objects[1].shape).normal, glm::dvec3(0, 0, 1));
    EXPECT_EQ(std::get<Disk>(scene.objects[1].shape).radius, 4);
    EXPECT_EQ(scene.medium, (Medium{"haze", {1, 2, 3}, {4, 5, 6}, -0.5F}));
    EXPECT_EQ(scene.lens, (Lens{0.25, 7}));
    ASSERT_EQ(scene.lights.size(), 3U);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].kind, PunctualLight::Kind::kPoint);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(7, 8, 9));
    EXPECT_EQ(scene.lights[1].kind, PunctualLight::Kind::kSpot);
    EXPECT_EQ(scene.lights[1].position, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.lights[1].direction, glm::dvec3(0, -1, 0));
    EXPECT_DOUBLE_EQ(scene.lights[1].inner_cone, glm::radians(10.0));
    EXPECT_DOUBLE_EQ(scene.lights[1].outer_cone, glm::radians(20.0));
    EXPECT_EQ(scene.lights[2].kind, PunctualLight::Kind::kDirectional);
    EXPECT_EQ(scene.lights[2].direction, glm::dvec3(1, 0, 0));
}

/// However narrow the cones are, they have an edge that a number can hold.
TEST(SceneJson, SpotsHaveASoftEdge)
{
    for (const char* cones : {R"("outer_cone_degrees": 1e-7)", R"("outer_cone_degrees": 1e-300)",
             R"("inner_cone_degrees": 44.9999999999999, "outer_cone_degrees": 45)"}) {
        const Scene scene = parse_scene(std::string(R"({"version": 1, "materials": {"m": {}},
            "objects": [{"material": "m", "sphere": {"center": [0, 0, 0], "radius": 1}}],
            "lights": {"lamp": {"intensity": [1, 1, 1], "spot": {"position": [0, 4, 0],
                "direction": [0, -1, 0], )")
                + cones + "}}}}",
            ".", "test.json");
        ASSERT_EQ(scene.lights.size(), 1U);
        const PunctualLight& light = scene.lights[0];
        EXPECT_LT(light.inner_cone, light.outer_cone) << cones;
        EXPECT_GT(static_cast<float>(std::cos(light.inner_cone)),
            static_cast<float>(std::cos(light.outer_cone)))
            << cones;
        EXPECT_THAT(scene.notes, testing::Contains(testing::HasSubstr("its cones made wide")))
            << cones;
    }
}

TEST(SceneJson, AnEnvironmentIsTurnedAndScaled)
{
    const Scene scene = parse_scene(R"({"version": 1, "materials": {"m": {}},
        "objects": [{"material": "m", "sphere": {"center": [0, 0, 0], "radius": 1}}],
        "environment": {"file": "linear_sky.exr", "scale": [1, 2, 3], "rotation_degrees": [0, 90, 0]}})",
        std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes", "test.json");
    ASSERT_NE(scene.environment, nullptr);
    EXPECT_EQ(scene.environment->height, 32U);
    EXPECT_EQ(scene.background, glm::vec3(1, 2, 3));
    // Turned by 90 degrees about y, the map's middle, -z, lies along -x.
    const glm::vec3 in_map = scene.map_from_world * glm::vec3(-1, 0, 0);
    EXPECT_LT(glm::length(in_map - glm::vec3(0, 0, -1)), 1e-6F);
}

TEST(SceneJson, AFileThatDoesNotLoadNamesBothFiles)
{
    const TempFolder folder;
    const auto part = folder.write("part.gltf", R"({"asset": {"version": "1.0"}})");
    try {
        parse(R"([{"mesh": {"file": "part.gltf"}}])", folder.path());
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(std::string(error.what()),
            "test.json: /objects/0/mesh/file: in " + part.string()
                + ": /asset/version: found \"1.0\", expected a glTF version 2.x");
    }
}

TEST(SceneJson, KeyframesInheritWhatTheyDoNotSay)
{
    const Scene scene = parse_scene(R"({"version": 1, "materials": {"m": {}},
        "objects": [{"material": "m", "sphere": {"center": [0, 0, 0], "radius": 1}}],
        "camera": {"position": [0, 0, 9], "target": [0, 0, 0], "vertical_fov_degrees": 30},
        "camera_paths": {"p": [{"frame": 0}, {"frame": 2.5, "target": [0, 1, 0]},
                               {"frame": 4, "vertical_fov_degrees": 60}]}})",
        ".", "test.json");
    const auto& path = scene.camera_paths.at("p");
    ASSERT_EQ(path.size(), 3U);
    EXPECT_EQ(path[0].pose, scene.camera);
    EXPECT_EQ(path[1].frame, 2.5);
    EXPECT_EQ(path[1].pose.target, glm::dvec3(0, 1, 0));
    EXPECT_EQ(path[1].pose.vertical_fov_degrees, 30);
    EXPECT_EQ(path[2].pose.target, glm::dvec3(0, 1, 0));
    EXPECT_EQ(path[2].pose.vertical_fov_degrees, 60);
    EXPECT_EQ(path[2].pose.position, glm::dvec3(0, 0, 9));
}

TEST(SceneJson, WithoutACameraEverythingIsInView)
{
    const Scene scene = parse_scene(R"({"version": 1, "materials": {"m": {}},
        "objects": [{"material": "m", "box": {"lower": [10, 0, 0], "upper": [14, 1, 2]}}]})",
        ".", "test.json");
    const glm::dvec3 view = scene.camera.target - scene.camera.position;
    const double half_angle = glm::radians(scene.camera.vertical_fov_degrees) / 2;
    EXPECT_EQ(scene.camera.target, glm::dvec3(12, 0.5, 1));
    EXPECT_NEAR(glm::length(view) * std::sin(half_angle), scene_bounds(scene).radius(), 1e-9);
    EXPECT_LT(view.y, 0);  // from above
    EXPECT_THAT(
        scene.notes, ElementsAre("the file has no camera: one was placed that sees everything"));
}

}  // namespace
}  // namespace farlight
