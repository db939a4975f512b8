// Which lights a scene has, how strong they are, and how likely each is chosen.
#include "server/scene/environment.h"
#include "server/scene/packed_scene.h"
#include "shaders/shared/scene_layout.h"

#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>
#include <random>

namespace farlight {
namespace {

using std::numbers::pi;

Scene scene_with(Material material)
{
    Scene scene;
    scene.materials = {{"dark"}, std::move(material)};
    return scene;
}

TEST(Lights, AreNotEmittersWithoutPowerOrArea)
{
    Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
    scene.meshes.push_back(
        {"degenerate", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}, {0, 1, 3}}});
    scene.objects.push_back({"dark quad", 0, Quad{}});
    scene.objects.push_back({"half degenerate", 1, MeshInstance{0, glm::dmat4(1)}});
    scene.objects.push_back({"bright ball", 1, Sphere{{5, 0, 0}, 1}});
    scene.objects.push_back({"bright disk", 1, Disk{}});
    scene.objects.push_back({"line", 1, Quad{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}});
    const PackedScene packed = pack_scene(scene);
    EXPECT_EQ(packed.lights->count(), 3U);
    EXPECT_EQ(packed.content.emissive_triangles, 1U);
    EXPECT_EQ(packed.content.sphere_lights, 1U);
    EXPECT_EQ(packed.content.disk_lights, 1U);
    EXPECT_EQ(packed.content.polygon_lights, 0U);
    for (const Light& light : packed.lights->all())
        EXPECT_GT(light.pmf, 0);
}

double power_of(const Object& object, Material material)
{
    Scene scene = scene_with(std::move(material));
    scene.objects.push_back(object);
    scene.objects.back().material = 1;
    const PackedScene packed = pack_scene(scene);
    return packed.lights->all().at(0).power;
}

TEST(Lights, HaveTheFluxTheyEmit)
{
    Material light{"light", glm::vec3(0), glm::vec3(2)};
    EXPECT_NEAR(power_of({"", 1, Sphere{{}, 3}}, light), pi * 2 * 4 * pi * 9, 1e-3);
    EXPECT_NEAR(power_of({"", 1, Disk{{}, {0, 0, 1}, 3}}, light), pi * 2 * pi * 9, 1e-3);
    EXPECT_NEAR(power_of({"", 1, Quad{{}, {3, 0, 0}, {1, 2, 0}}}, light), pi * 2 * 6, 1e-4);
    light.emits_both_sides = true;
    EXPECT_NEAR(power_of({"", 1, Quad{{}, {3, 0, 0}, {1, 2, 0}}}, light), 2 * pi * 2 * 6, 1e-4);
    light.alpha_mode = AlphaMode::kBlend;
    light.opacity = 0.25F;
    EXPECT_NEAR(power_of({"", 1, Quad{{}, {3, 0, 0}, {1, 2, 0}}}, light), pi * 6, 1e-4);
}

TEST(PunctualLights, HaveTheFluxOfTheirFalloff)
{
    PunctualLight light;
    light.intensity = glm::vec3(3);
    const auto power = [&] { return light_power(light_of(light, glm::dmat4(1)), 5); };
    EXPECT_NEAR(power(), 4 * pi * 3, 1e-4);
    light.kind = PunctualLight::Kind::kDirectional;
    EXPECT_NEAR(power(), 3 * pi * 25, 1e-3);
    light.kind = PunctualLight::Kind::kSpot;
    light.inner_cone = 0.3;
    light.outer_cone = 0.9;
    double expected = 0;  // midpoint rule over the angle from the axis
    constexpr int kSteps = 10000;
    for (int i = 0; i < kSteps; ++i) {
        const double theta = 0.9 * (i + 0.5) / kSteps;
        const double x = std::clamp(
            (std::cos(theta) - std::cos(0.9)) / (std::cos(0.3) - std::cos(0.9)), 0.0, 1.0);
        expected += 3 * x * x * 2 * pi * std::sin(theta) * 0.9 / kSteps;
    }
    EXPECT_NEAR(power(), expected, 1e-4 * expected);
}

/// Left half white, right half black.
Image8 half_white(std::uint32_t size)
{
    Image8 image{"half", size, size, {}};
    for (std::uint32_t i = 0; i < size * size; ++i)
        image.texels.push_back(i % size < size / 2 ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255));
    return image;
}

/// Two triangles that show one half of the picture each, at place `u` of it and to the right.
Scene textured_strip(float u, float width)
{
    Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
    scene.images.push_back(half_white(64));
    scene.materials[1].emission_texture.image = 0;
    Mesh mesh{"strip", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}};
    mesh.uvs[0] = {{u, 0.2F}, {u + width, 0.2F}, {u, 0.8F}};
    scene.meshes.push_back(mesh);
    scene.objects.push_back({"strip", 1, MeshInstance{}});
    return scene;
}

TEST(TexturedLights, HaveTheMeanPowerOfTheirTexels)
{
    const auto luminance_at = [](float u, float width) {
        const Scene scene = textured_strip(u, width);
        return pack_scene(scene).lights->all().at(0).mean_luminance;
    };
    EXPECT_NEAR(luminance_at(0.1F, 0.3F), 1, 1e-6);
    EXPECT_EQ(luminance_at(0.6F, 0.3F), 0);
    // Of the triangle from u = 0.25 to 0.75, three quarters lie left of the middle. A tenth: eight
    // columns of places, of which the middle one may fall on either side.
    EXPECT_NEAR(luminance_at(0.25F, 0.5F), 0.75, 0.1);
}

TEST(TexturedLights, AreNeverChosenWhereTheirTexelsAreBlack)
{
    Scene scene = textured_strip(0.6F, 0.3F);
    scene.materials.push_back({"plain", glm::vec3(0), glm::vec3(1)});
    scene.objects.push_back({"lamp", 2, Disk{}});
    const PackedScene packed = pack_scene(scene);
    EXPECT_EQ(packed.lights->all().at(0).pmf, 0);
    EXPECT_EQ(packed.lights->all().at(1).pmf, 1);
}

TEST(TexturedLights, OnASphereOrADiskAreLeftToTheBsdf)
{
    Scene scene = textured_strip(0, 0.3F);
    scene.objects.push_back({"ball", 1, Sphere{}});
    scene.objects.push_back({"coin", 1, Disk{}});
    EXPECT_TRUE(is_sampled(scene, scene.objects[0]));
    EXPECT_FALSE(is_sampled(scene, scene.objects[1]));
    EXPECT_FALSE(is_sampled(scene, scene.objects[2]));
}

/// A picture that shows the light through a comb of one column in four.
TEST(TexturedLights, OfAMaskHaveThePowerOfWhatIsLeft)
{
    Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
    Image8 comb{"comb", 8, 1, {}};
    for (int i = 0; i < 8; ++i)
        comb.texels.push_back(glm::u8vec4(255, 255, 255, i % 4 == 0 ? 255 : 0));
    scene.images.push_back(comb);
    scene.materials[1].alpha_mode = AlphaMode::kMask;
    scene.materials[1].albedo_texture.image = 0;
    scene.objects.push_back({"quad", 1, Quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    EXPECT_NEAR(pack_scene(scene).lights->all().at(0).mean_luminance, 0.25, 1e-6);
}

TEST(Lights, LieWhereARestingCarrierHasThem)
{
    Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
    scene.animation.nodes.push_back({"carrier"});
    scene.animation.nodes[0].translation = {1, 2, 3};
    scene.animation.nodes[0].scale = glm::dvec3(2);
    scene.objects.push_back({"coin", 1, Disk{}});
    scene.objects.push_back({"ball", 1, Sphere{}});
    for (Object& object : scene.objects)
        object.node = 0;
    const PackedScene packed = pack_scene(scene);
    for (const Light& light : packed.lights->all()) {
        EXPECT_EQ(light.p0, glm::vec3(1, 2, 3));
        EXPECT_EQ(light.edge_u.x, 2);
    }
}

EnvironmentMap random_map(std::uint32_t width, std::uint32_t height)
{
    std::mt19937 random(5);
    EnvironmentMap map{"map", width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
        map.texels.emplace_back(random() % 7, random() % 5, random() % 3);
    return map;
}

TEST(Environments, SampleEveryTexelWithADensityThatIntegratesToOne)
{
    for (const auto& [width, height] : {std::pair{8U, 4U}, {5U, 3U}, {1U, 1U}}) {
        EnvironmentMap map = random_map(width, height);
        map.texels[0] = glm::vec3(1000, 2000, 3000);
        const PackedEnvironment packed = pack_environment(map, glm::mat3(1));
        double sum = 0;
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x)
                sum += static_cast<double>(glm::uintBitsToFloat(
                           packed.texels[ENVIRONMENT_HEADER_TEXELS + y * width + x].w))
                    * 2 * pi / width
                    * (std::cos(pi * y / height) - std::cos(pi * (y + 1) / height));
        EXPECT_NEAR(sum, 1, 1e-6) << width << "x" << height;
    }
}

TEST(Environments, OfOneColourHaveThatMean)
{
    EnvironmentMap map = random_map(16, 8);
    for (glm::vec3& texel : map.texels)
        texel = glm::vec3(1, 2, 3);
    const glm::dvec3 mean = pack_environment(map, glm::mat3(1)).mean_radiance;
    EXPECT_NEAR(glm::length(mean - glm::dvec3(1, 2, 3)), 0, 1e-9);
}

/// One light of each kind, with tracks' factors applied.
TEST(LightTables, FollowTheirPose)
{
    Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
    scene.objects.push_back({"quad", 1, Quad{}});
    scene.lights.push_back({.name = "lamp", .node = 0});
    scene.animation.nodes.push_back({"carrier"});
    scene.background = glm::vec3(1);
    scene.environment = std::make_shared<EnvironmentMap>(random_map(8, 4));
    LightTable table = *pack_scene(scene).lights;
    const std::vector<Light> rest = table.all();
    const auto total = [&] {
        double sum = 0;
        for (const Light& light : table.all())
            sum += static_cast<double>(light.pmf);
        return sum;
    };
    ASSERT_EQ(rest.size(), 3U);
    EXPECT_NEAR(total(), 1, 1e-6);

    const float emission[] = {1, 3};
    const float intensity[] = {0};
    const glm::dmat4 nodes[] = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {5, 6, 7, 1}}};
    Light moved = rest[0];
    moved.p0 = {1, 2, 3};
    moved.area *= 2;
    table.update(std::span(&moved, 1), {emission, intensity, nodes, 0.5F});
    EXPECT_EQ(table.all()[0].radiance, glm::vec3(3));
    EXPECT_EQ(table.all()[0].p0, glm::vec3(1, 2, 3));
    EXPECT_NEAR(table.all()[0].power, 6 * rest[0].power, 1e-6);
    EXPECT_EQ(table.all()[1].power, 0);
    EXPECT_EQ(table.all()[1].pmf, 0);
    EXPECT_EQ(table.all()[1].p0, glm::vec3(5, 6, 7));
    EXPECT_NEAR(table.all()[2].power, 0.5 * rest[2].power, 1e-6);
    EXPECT_NEAR(total(), 1, 1e-6);

    table.update(std::span(rest.data(), 1), {});
    for (std::size_t i = 0; i < rest.size(); ++i) {
        EXPECT_EQ(table.all()[i].pmf, rest[i].pmf) << i;
        EXPECT_EQ(table.all()[i].radiance, rest[i].radiance) << i;
    }
    const float dark[] = {0, 0};
    table.update({}, {dark, intensity, {}, 0});
    EXPECT_EQ(total(), 0);
}

/// The light that a trail leads to, and how many children lie on the way.
std::pair<std::uint32_t, int> follow(const LightTree& tree, std::uint32_t trail)
{
    std::uint32_t node = 0;
    for (int level = 0;; ++level) {
        const std::uint32_t link = tree.nodes.at(node * LIGHT_NODE_TEXELS + 2).z;
        if ((link & LIGHT_NODE_LEAF) != 0)
            return {link & ~LIGHT_NODE_LEAF, level};
        node = (trail & 1U) == 0 ? node + 1 : link;
        trail >>= 1U;
    }
}

/// Place of light i of n in a scene that a tree may stumble over.
struct TreeCase {
    const char* name;
    std::size_t lights;
    std::function<glm::vec3(std::size_t)> place;

    friend void PrintTo(const TreeCase& c, std::ostream* out) { *out << c.name; }
};

class LightTreeTest : public testing::TestWithParam<TreeCase> { };

TEST_P(LightTreeTest, EveryTrailLeadsToItsLight)
{
    const TreeCase& c = GetParam();
    std::vector<Light> lights;
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < c.lights; ++i) {
        lights.push_back({.kind = LIGHT_POINT, .p0 = c.place(i), .mean_luminance = 1});
        indices.push_back(static_cast<std::uint32_t>(7 + 2 * i));
    }
    const LightTree tree = build_light_tree(lights, indices);
    EXPECT_EQ(tree.nodes.size(), (2 * c.lights - 1) * LIGHT_NODE_TEXELS);
    for (std::size_t i = 0; i < c.lights; ++i) {
        const auto [light, level] = follow(tree, tree.trails[i]);
        EXPECT_EQ(light, indices[i]);
        EXPECT_LE(level, 32);
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, LightTreeTest,
    testing::Values(TreeCase{"One", 1, [](std::size_t) { return glm::vec3(1); }},
        TreeCase{"AllInOnePlace", 1000, [](std::size_t) { return glm::vec3(1, 2, 3); }},
        // Each twice as far as the one before: cut by place, every node would lose one light only.
        TreeCase{"DoublingDistances", 200,
            [](std::size_t i) {
                return glm::vec3(std::ldexp(1.0F, static_cast<int>(i % 120)), 0, 0);
            }},
        TreeCase{
            "Grid", 4096, [](std::size_t i) { return glm::vec3(i % 16, i / 16 % 16, i / 256); }}),
    [](const auto& test) { return test.param.name; });

/// What has collapsed is never chosen, wherever it stands in the order, and darkens nothing else.
TEST(LightTrees, GoOnWithCollapsedLights)
{
    for (std::size_t place = 0; place < 4; ++place) {
        Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
        scene.animation.nodes.push_back({"carrier"});
        for (std::size_t i = 0; i < 4; ++i) {
            const auto x = static_cast<double>(i);
            scene.objects.push_back({"quad", 1, Quad{{x, 0, 0}, {0.1, 0, 0}, {0, 0, 0.1}}});
            scene.lights.push_back({.name = "spot",
                .kind = PunctualLight::Kind::kSpot,
                .position = {x, 1, 0},
                .node = i == place ? 0 : kNone});
        }
        scene.lights.push_back(
            {.name = "sun", .kind = PunctualLight::Kind::kDirectional, .node = 0});
        LightTable table = *pack_scene(scene).lights;
        std::vector<Light> shapes(table.all().begin(), table.all().begin() + 4);
        shapes[place].edge_u = shapes[place].edge_v = glm::vec3(0);
        shapes[place].area = 0;
        const glm::dmat4 nodes[] = {glm::dmat4(0)};
        table.update(shapes, {.world_from_node = nodes});
        for (std::size_t i = 0; i < table.count(); ++i) {
            const bool collapsed = i % 4 == place || i == 8;
            EXPECT_EQ(table.all()[i].power > 0, !collapsed) << i << ", " << place << " collapsed";
        }
        ASSERT_FALSE(table.tree().empty());
        EXPECT_EQ(glm::uintBitsToFloat(table.tree()[0].z), 1) << "the sun has gone out";
        for (std::uint32_t node = 0; node < table.tree()[0].x; ++node) {
            const std::size_t at = LIGHT_TREE_HEADER_TEXELS + node * LIGHT_NODE_TEXELS;
            const glm::vec4 box = glm::uintBitsToFloat(table.tree()[at]);
            const glm::vec4 cone = glm::uintBitsToFloat(table.tree()[at + 1]);
            EXPECT_TRUE(std::isfinite(glm::dot(box, box)));
            EXPECT_NEAR(glm::length(glm::vec3(cone)), 1, 1e-6);
            EXPECT_LE(std::abs(cone.w), 1);
        }
        const float lit = 3 * 0.01F + 3;  // quads of radiance 1 and area 0.01, spots of 1 cd
        EXPECT_NEAR(
            glm::uintBitsToFloat(table.tree()[LIGHT_TREE_HEADER_TEXELS + 2].x), lit, 1e-6 * lit);
    }
}

/// Joining lights loses nothing: the root shines wherever a light does.
TEST(LightTrees, BoundTheirLights)
{
    Scene scene = scene_with({"light", glm::vec3(0), glm::vec3(1)});
    scene.objects.push_back({"up", 1, Quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});  // faces +z
    scene.objects.push_back({"aside", 1, Quad{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}}});  // faces +x
    const PackedScene packed = pack_scene(scene);
    const std::uint32_t indices[] = {0, 1};
    const LightTree tree = build_light_tree(packed.lights->all(), indices);
    const glm::vec4 place = glm::uintBitsToFloat(tree.nodes[0]);
    const glm::vec4 cone = glm::uintBitsToFloat(tree.nodes[1]);
    EXPECT_NEAR(glm::length(glm::vec3(place) - glm::vec3(1, 0.5F, 0.5F)), 0, 1e-6);
    EXPECT_NEAR(place.w, std::sqrt(6.0) / 2, 1e-6);
    EXPECT_NEAR(glm::dot(glm::vec3(cone), glm::vec3(0, 0, 1)), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(glm::dot(glm::vec3(cone), glm::vec3(1, 0, 0)), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(cone.w, std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(glm::uintBitsToFloat(tree.nodes[2].x), 2, 1e-6);
}

}  // namespace
}  // namespace farlight
