// The scenes in scenes/ are what their README says they are.
#include "server/scene/scene_file.h"
#include "server/scene/scene_origin.h"
#include "tests/support/shipped_scenes.h"

#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

namespace farlight {
namespace {

const std::filesystem::path kScenes = std::filesystem::path(FARLIGHT_SOURCE_DIR) / "scenes";

class ShippedSceneTest : public testing::TestWithParam<std::filesystem::path> { };

TEST_P(ShippedSceneTest, LoadsWithoutNotesAndHasARowInTheReadme)
{
    const Scene scene = load_scene(GetParam());
    EXPECT_THAT(scene.notes, testing::IsEmpty());
    EXPECT_FALSE(scene.name.empty());
    EXPECT_FALSE(is_wide(scene)) << "drawn more slowly than it need be";
    for (const Object& object : scene.objects)
        EXPECT_THAT(object.name, testing::Not(testing::StartsWith("object ")));

    std::ifstream readme(kScenes / "README.md");
    const std::string text{std::istreambuf_iterator<char>(readme), {}};
    EXPECT_THAT(text, testing::HasSubstr("| `" + GetParam().filename().string() + "` |"));
}

INSTANTIATE_TEST_SUITE_P(All, ShippedSceneTest, testing::ValuesIn(shipped_scenes()),
    [](const auto& row) { return row.param.stem().string(); });

const Object& object_named(const Scene& scene, const std::string& name)
{
    const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
        [&](const Object& object) { return object.name == name; });
    if (found == scene.objects.end())
        throw std::runtime_error("no object " + name);
    return *found;
}

const Material& material_of(const Scene& scene, const std::string& name)
{
    return scene.materials[object_named(scene, name).material];
}

const Mesh& mesh_of(const Scene& scene, const std::string& name)
{
    return scene.meshes[std::get<MeshInstance>(object_named(scene, name).shape).mesh];
}

struct Band {
    double first, last;  // [nm], both included
};
constexpr std::array<Band, 3> kBands{{{600, 700}, {500, 600}, {400, 500}}};  // r, g, b

/// Column name -> wavelength -> value.
std::map<std::string, std::map<double, double>> read_spectra()
{
    std::ifstream file(kScenes / "cornell_box_spectra.csv");
    const auto split = [](const std::string& line) {
        std::vector<std::string> cells;
        std::stringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');)
            cells.push_back(cell);
        return cells;
    };
    std::string line;
    std::getline(file, line);
    const std::vector<std::string> names = split(line);
    std::map<std::string, std::map<double, double>> spectra;
    while (std::getline(file, line)) {
        const std::vector<std::string> cells = split(line);
        for (std::size_t i = 1; i < cells.size(); ++i)
            if (!cells[i].empty())
                spectra[names[i]][std::stod(cells[0])] = std::stod(cells[i]);
    }
    return spectra;
}

double interpolated(const std::map<double, double>& samples, double at)
{
    const auto above = samples.lower_bound(at);
    if (above->first == at)
        return above->second;
    const auto below = std::prev(above);
    return std::lerp(
        below->second, above->second, (at - below->first) / (above->first - below->first));
}

TEST(CornellBox, ColoursAreTheBandMeansOfTheSpectra)
{
    const Scene scene = load_scene(kScenes / "cornell_box.json");
    auto spectra = read_spectra();
    ASSERT_EQ(spectra["white"].size(), 76U);  // 400 to 700 nm in steps of 4
    ASSERT_EQ(spectra["light"].size(), 4U);
    for (const auto& [spectrum, object] :
        {std::pair("white", "floor"), std::pair("green", "right wall"),
            std::pair("red", "left wall"), std::pair("light", "light")})
        for (int channel = 0; channel < 3; ++channel) {
            double sum = 0;
            int count = 0;
            for (double nm = kBands[channel].first; nm <= kBands[channel].last; nm += 4, ++count)
                sum += interpolated(spectra[spectrum], nm);
            const Material& material = material_of(scene, object);
            const glm::vec3 color =
                spectrum == std::string("light") ? material.emission : material.albedo;
            EXPECT_NEAR(color[channel], sum / count, 1e-3) << spectrum << ' ' << channel;
        }
}

TEST(CornellBox, GeometryIsAsPublished)
{
    const Scene scene = load_scene(kScenes / "cornell_box.json");
    EXPECT_THAT(mesh_of(scene, "floor").positions,
        testing::ElementsAre(glm::vec3(552.8F, 0, 0), glm::vec3(0), glm::vec3(0, 0, 559.2F),
            glm::vec3(549.6F, 0, 559.2F)));
    EXPECT_THAT(mesh_of(scene, "left wall").positions,
        testing::ElementsAre(glm::vec3(552.8F, 0, 0), glm::vec3(549.6F, 0, 559.2F),
            glm::vec3(556, 548.8F, 559.2F), glm::vec3(556, 548.8F, 0)));
    EXPECT_THAT(mesh_of(scene, "short block").positions,
        testing::IsSupersetOf({glm::vec3(130, 165, 65), glm::vec3(290, 0, 114)}));
    EXPECT_THAT(mesh_of(scene, "tall block").positions,
        testing::IsSupersetOf({glm::vec3(423, 330, 247), glm::vec3(472, 0, 406)}));
    EXPECT_NEAR(scene.camera.vertical_fov_degrees, 39.3077, 1e-4);
    EXPECT_EQ(scene.camera.position, glm::dvec3(278, 273, -800));
    // The camera sees red on the left: its right is -x.
    const glm::dvec3 view = scene.camera.target - scene.camera.position;
    EXPECT_LT(glm::cross(view, scene.camera.up).x, 0);
}

TEST(CornellBox, TheLightFacesDownIntoTheCeilingsOpening)
{
    const Scene scene = load_scene(kScenes / "cornell_box.json");
    const auto& light = std::get<Quad>(object_named(scene, "light").shape);
    EXPECT_EQ(glm::cross(light.edge_u, light.edge_v), glm::dvec3(0, -130 * 105, 0));
    double ceiling = 0;
    for (const Object& object : scene.objects)
        if (object.name.starts_with("ceiling")) {
            const auto& part = std::get<Quad>(object.shape);
            const glm::dvec3 area = glm::cross(part.edge_u, part.edge_v);
            EXPECT_LT(area.y, 0);  // faces down
            ceiling += glm::length(area);
        }
    EXPECT_NEAR(ceiling + 130 * 105, 556 * 559.2, 1e-6);
}

/// Each face of a closed block looks away from the block's middle; walls towards the room's.
TEST(CornellBox, FacesLookIntoTheRoom)
{
    const Scene scene = load_scene(kScenes / "cornell_box.json");
    for (const Object& object : scene.objects) {
        const auto* instance = std::get_if<MeshInstance>(&object.shape);
        if (instance == nullptr)
            continue;
        const Mesh& mesh = scene.meshes[instance->mesh];
        const bool block = object.name.ends_with("block");
        glm::vec3 middle(0);
        for (const glm::vec3& p : mesh.positions)
            middle += p / static_cast<float>(mesh.positions.size());
        if (!block)
            middle = {278, 274, 279};
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x];
            const glm::vec3 normal = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
            EXPECT_EQ(glm::dot(normal, a - middle) > 0, block) << object.name;
        }
    }
}

TEST(FourSpheres, HasFourOfThemAndALamp)
{
    const Scene scene = load_scene(kScenes / "four_spheres.json");
    std::vector<double> radii;
    for (const Object& object : scene.objects)
        if (const auto* sphere = std::get_if<Sphere>(&object.shape))
            radii.push_back(sphere->radius);
    EXPECT_THAT(radii, testing::ElementsAre(100, 0.75, 1, 0.6));
    EXPECT_GT(material_of(scene, "lamp").emission.x, 0);
    EXPECT_GT(scene.background.x, 0);
}

TEST(Furnace, IsAClosedBoxOfOneMaterialAroundTheCamera)
{
    const Scene scene = load_scene(kScenes / "furnace.json");
    ASSERT_EQ(scene.objects.size(), 1U);
    const Material& wall = material_of(scene, "box");
    EXPECT_EQ(wall.albedo, glm::vec3(0.5F));
    EXPECT_EQ(wall.emission, glm::vec3(1));
    EXPECT_TRUE(wall.emits_both_sides);
    const Bounds bounds = scene_bounds(scene);
    EXPECT_TRUE(glm::all(glm::lessThan(bounds.lower, scene.camera.position)));
    EXPECT_TRUE(glm::all(glm::lessThan(scene.camera.position, bounds.upper)));
}

TEST(MeshScene, TheMeshIsClosedAndHasSixHundredTriangles)
{
    const Scene scene = load_scene(kScenes / "mesh.json");
    const Mesh& knot = mesh_of(scene, "knot");
    EXPECT_EQ(knot.triangles.size(), 600U);
    EXPECT_EQ(knot.normals.size(), knot.positions.size());
    std::map<std::pair<unsigned, unsigned>, int> edges;
    double volume = 0;
    for (const glm::uvec3& t : knot.triangles) {
        for (int i = 0; i < 3; ++i)
            ++edges[{t[i], t[(i + 1) % 3]}];
        volume += glm::dot(glm::dvec3(knot.positions[t.x]),
            glm::cross(glm::dvec3(knot.positions[t.y]), glm::dvec3(knot.positions[t.z])));
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
    EXPECT_GT(volume, 0);  // counter-clockwise from outside
}

TEST(MeshScene, TheBaffleHidesTheLampFromEveryVertex)
{
    const Scene scene = load_scene(kScenes / "mesh.json");
    const auto& lamp = std::get<Quad>(object_named(scene, "lamp").shape);
    const auto& knot = std::get<MeshInstance>(object_named(scene, "knot").shape);
    const auto& baffle = std::get<MeshInstance>(object_named(scene, "baffle").shape);
    Bounds block;
    for (const glm::vec3& p : scene.meshes[baffle.mesh].positions)
        block.extend(glm::dvec3(baffle.world_from_object * glm::dvec4(p, 1)));
    // The lamp is convex and so is what the baffle's side hides, so the lamp's corners suffice.
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), {0, 1}, {1, 0}, {1, 1}}) {
        const glm::dvec3 from = lamp.corner + corner.x * lamp.edge_u + corner.y * lamp.edge_v;
        for (const glm::vec3& p : scene.meshes[knot.mesh].positions) {
            const glm::dvec3 to = knot.world_from_object * glm::dvec4(p, 1);
            ASSERT_LT(from.x, block.lower.x);
            ASSERT_GT(to.x, block.upper.x);
            const glm::dvec3 crossing =
                glm::mix(from, to, (block.lower.x - from.x) / (to.x - from.x));
            EXPECT_LT(crossing.y, block.upper.y);
            EXPECT_GT(crossing.y, block.lower.y);
            EXPECT_GT(crossing.z, block.lower.z);
            EXPECT_LT(crossing.z, block.upper.z);
        }
    }
}

TEST(MeshScene, CameraPathsStayInTheRoom)
{
    const Scene scene = load_scene(kScenes / "mesh.json");
    for (const auto& [name, path] : scene.camera_paths)
        for (const CameraKeyframe& key : path) {
            EXPECT_LT(std::abs(key.pose.position.x), 2.95) << name << ' ' << key.frame;
            EXPECT_LT(std::abs(key.pose.position.z), 2.95) << name << ' ' << key.frame;
        }
}

TEST(CameraPaths, OrbitAndDollyInAllButTheFurnace)
{
    for (const char* const file : {"cornell_box.json", "four_spheres.json", "mesh.json"}) {
        const Scene scene = load_scene(kScenes / file);
        for (const char* const path : {"orbit", "dolly"}) {
            ASSERT_EQ(scene.camera_paths.count(path), 1U) << file << ' ' << path;
            const auto& keys = scene.camera_paths.at(path);
            EXPECT_LT(glm::length(keys.front().pose.position - scene.camera.position), 1e-3);
            EXPECT_GE(keys.back().frame, 120);
        }
    }
}

}  // namespace
}  // namespace farlight
