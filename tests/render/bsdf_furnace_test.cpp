// White things of every material under a white sky disappear: the path tracer, its textures and
// insides lose and gain nothing. Shading normals that are not the surface's: lab/cases_normals.cpp.
//
// Seeds are fixed; the bounds are 5 standard errors, which a fresh seed would exceed once in 1.7
// million, and what the albedo tables are interpolated to, 2e-3 a bounce.
#include "lab/lossless_materials.h"
#include "lab/statistics.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

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
    EXPECT_EQ(frame.bad_values.all(), 0U);
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
        MaterialFurnaceCase{"Nested", nested(), 6e-3}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
