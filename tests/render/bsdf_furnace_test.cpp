// White things of every material under a white sky disappear: the path tracer, its textures, normal
// maps and insides lose and gain nothing.
//
// Seeds are fixed; the bounds are 5 standard errors, which a fresh seed would exceed once in 1.7
// million, and what the albedo tables are interpolated to, 2e-3 a bounce.
#include "lab/lossless_materials.h"
#include "lab/meshes.h"
#include "lab/statistics.h"
#include "tests/support/gl_test.h"

#include <functional>
#include <random>

namespace farlight {
namespace {

/// Normals all over the upper hemisphere, down to 17 degrees above the surface.
Image8 wild_normals()
{
    Image8 image{"normals", 16, 16, {}};
    std::mt19937 random(5);
    std::uniform_real_distribution<float> turn(0, 6.2831853F);
    std::uniform_real_distribution<float> height(0.3F, 1);
    for (int i = 0; i < 16 * 16; ++i) {
        const float z = height(random);
        const float phi = turn(random);
        const float r = std::sqrt(1 - z * z);
        const glm::vec3 n(r * std::cos(phi), r * std::sin(phi), z);
        image.texels.emplace_back(glm::u8vec3(glm::round((n * 0.5F + 0.5F) * 255.0F)), 255);
    }
    return image;
}

Scene under_a_white_sky()
{
    Scene scene;
    scene.background = glm::vec3(1);
    scene.camera.position = {0, 1.2, 3};
    scene.camera.target = {0, 0, 0};
    return scene;
}

Scene ball(const Material& material)
{
    Scene scene = under_a_white_sky();
    scene.materials.push_back(material);
    scene.objects.push_back({"ball", 0, Sphere{{0, 0, 0}, 1}});
    return scene;
}

/// A slanted square whose normal map sends light everywhere.
Scene rough_relief(Material material)
{
    Scene scene = under_a_white_sky();
    scene.images.push_back(wild_normals());
    material.normal_texture.image = 0;
    scene.materials.push_back(std::move(material));
    scene.objects.push_back({"relief", 0, Quad{{-1.5, -0.3, 1}, {3, 0, 0}, {0, 0.6, -2}}});
    return scene;
}

Scene smooth_bumps(const Material& material)
{
    Mesh mesh = bumpy_sphere(24, 12);
    for (const glm::vec3& position : mesh.positions)
        mesh.normals.push_back(glm::normalize(position));
    Scene scene = scene_of(std::move(mesh));
    scene.background = glm::vec3(1);
    scene.materials[0] = material;
    return scene;
}

/// A denser ball in a ball, and one that overlaps both.
Scene nested()
{
    Scene scene = ball(lossless::glass(0));
    Material dense = lossless::glass(0);
    dense.ior = 2;
    dense.priority = 1;
    Material light = lossless::glass(0.3F);
    light.ior = 1.2F;
    light.priority = -1;
    scene.materials.push_back(dense);
    scene.materials.push_back(light);
    scene.objects.push_back({"dense", 1, Sphere{{0.2, 0, 0}, 0.5}});
    scene.objects.push_back({"overlapping", 2, Sphere{{0.9, 0.1, 0.2}, 0.6}});
    return scene;
}

struct MaterialFurnaceCase {
    const char* name;
    Scene scene;
    double tolerance = 2e-3;

    friend void PrintTo(const MaterialFurnaceCase& c, std::ostream* out) { *out << c.name; }
};

class WhiteFurnace : public GlTest, public testing::WithParamInterface<MaterialFurnaceCase> { };

TEST_P(WhiteFurnace, EverythingWhiteDisappears)
{
    const DeviceScene scene(GetParam().scene);
    RenderRequest request = linear_request(scene.scene, {48, 36}, {});
    request.settings.denoiser = Denoiser::kAccumulate;
    request.settings.max_depth = 48;
    request.settings.roulette_depth = 48;
    request.settings.samples_per_pixel = 16;
    View view(scene.shared);
    RenderedFrame frame;
    for (int i = 0; i < 4; ++i)
        frame = view.render(request);
    EXPECT_EQ(frame.nonfinite_count, 0U);
    const Estimate estimate = mean_of(frame.image);
    EXPECT_NEAR(estimate.mean, 1, 5 * estimate.standard_error + GetParam().tolerance);
    EXPECT_LT(estimate.standard_error, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Bsdf, WhiteFurnace,
    testing::Values(MaterialFurnaceCase{"Metal", ball(lossless::white(1, 0.6F))},
        MaterialFurnaceCase{"Mirror", ball(lossless::white(1, 0))},
        MaterialFurnaceCase{"Plastic", ball(lossless::plastic(0.4F))},
        MaterialFurnaceCase{"Polished", ball(lossless::plastic(0))},
        MaterialFurnaceCase{"Coated", ball(lossless::coated(lossless::plastic(0.6F), 0.2F))},
        MaterialFurnaceCase{"Lacquer", ball(lossless::coated(lossless::white(0, 1), 0))},
        MaterialFurnaceCase{"Glass", ball(lossless::glass(0))},
        MaterialFurnaceCase{"RoughGlass", ball(lossless::glass(0.5F)), 6e-3},
        MaterialFurnaceCase{"Bubble", ball(lossless::thin_glass(0))},
        MaterialFurnaceCase{"FrostedBubble", ball(lossless::thin_glass(0.5F))},
        MaterialFurnaceCase{"Nested", nested(), 6e-3},
        MaterialFurnaceCase{"LambertRelief", rough_relief(lossless::white(0, 1))},
        MaterialFurnaceCase{"MetalRelief", rough_relief(lossless::white(1, 0.5F))},
        MaterialFurnaceCase{"MirrorRelief", rough_relief(lossless::white(1, 0))},
        MaterialFurnaceCase{"PlasticRelief", rough_relief(lossless::plastic(0.4F))},
        MaterialFurnaceCase{"BubbleRelief", rough_relief(lossless::thin_glass(0.4F))},
        MaterialFurnaceCase{"LambertBumps", smooth_bumps(lossless::white(0, 1))},
        MaterialFurnaceCase{"MetalBumps", smooth_bumps(lossless::white(1, 0.3F))},
        MaterialFurnaceCase{"GlassBumps", smooth_bumps(lossless::glass(0)), 4e-3}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
