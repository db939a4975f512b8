// Materials through the whole renderer: what loses nothing vanishes, glass and mirrors show their
// closed forms, and the split into signals loses nothing either.
//
// Statistical tests use fixed seeds, so they are deterministic; the bounds are 5 standard errors,
// which a fresh seed would exceed by chance once in 1.7 million.
#include "lab/lossless_materials.h"
#include "lab/statistics.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

constexpr Extent kPathExtent{48, 48};

RenderSettings settings_of(int max_depth, int samples)
{
    RenderSettings s;
    s.denoiser = Denoiser::kAccumulate;
    s.antialiasing = false;
    s.max_depth = max_depth;
    s.roulette_depth = 64;
    s.samples_per_pixel = samples;
    return s;
}

Image picture(const DeviceScene& scene, const RenderSettings& settings)
{
    View view(scene.shared);
    RenderedFrame frame = view.render(linear_request(scene.scene, kPathExtent, settings));
    EXPECT_EQ(frame.bad_values.all(), 0U);
    return std::move(frame.image);
}

struct Lossless {
    const char* name;
    Material material;
    double tolerance;

    friend void PrintTo(const Lossless& c, std::ostream* out) { *out << c.name; }
};

class ObjectFurnaceTest : public GlTest, public testing::WithParamInterface<Lossless> { };

/// Under a sky of radiance 1 a ball that loses nothing is not to be seen.
TEST_P(ObjectFurnaceTest, LosslessBallUnderAWhiteSkyVanishes)
{
    const auto& [name, material, tolerance] = GetParam();
    Scene scene;
    scene.materials.push_back(material);
    scene.objects.push_back({"ball", 0, Sphere{{0, 0, 0}, 1}});
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 42};
    const DeviceScene on_device(scene);
    const Estimate estimate = mean_of(picture(on_device, settings_of(64, 128)));
    EXPECT_NEAR(estimate.mean, 1, 5 * estimate.standard_error + tolerance);
    EXPECT_LT(estimate.standard_error, 0.004);
}

// The tolerance is that of the tables of albedos behind rough lobes; what needs none is exact.
INSTANTIATE_TEST_SUITE_P(Materials, ObjectFurnaceTest,
    testing::Values(Lossless{"Lambert", lossless::white(), 1e-5},
        Lossless{"Mirror", lossless::white(1, 0), 1e-5},
        Lossless{"SmoothMetal", lossless::white(1, 0.1F), 2e-3},
        Lossless{"RoughMetal", lossless::white(1, 0.6F), 2e-3},
        Lossless{"RoughestMetal", lossless::white(1, 1), 2e-3},
        Lossless{"SmoothPlastic", lossless::plastic(0), 2e-3},
        Lossless{"RoughPlastic", lossless::plastic(0.5F), 2e-3},
        Lossless{"CoatedLambert", lossless::coated(lossless::white(), 0.1F), 2e-3},
        Lossless{"CoatedMetal", lossless::coated(lossless::white(1, 0.5F), 0), 2e-3},
        Lossless{"Glass", lossless::glass(0), 1e-4},
        Lossless{"RoughGlass", lossless::glass(0.3F), 2e-3},
        Lossless{"RoughestGlass", lossless::glass(1), 3e-3},
        Lossless{"ThinGlass", lossless::thin_glass(0), 1e-4},
        Lossless{"ThinRoughGlass", lossless::thin_glass(0.4F), 2e-3}),
    [](const auto& test) { return test.param.name; });

/// A wall that shines, seen straight on through a plate; the camera sees a piece of it so small
/// that all rays meet the plate at a right angle.
Scene behind_plate(const Material& material, double thickness)
{
    Scene scene;
    scene.materials = {{"light", glm::vec3(0), glm::vec3(1)}, material};
    scene.objects.push_back({"wall", 0, Quad{{-5, -5, -3}, {10, 0, 0}, {0, 10, 0}}});
    const glm::dvec3 near(-4, -4, 0);
    scene.objects.push_back({"front", 1, Quad{near, {8, 0, 0}, {0, 8, 0}}});
    if (thickness > 0)
        scene.objects.push_back(
            {"back", 1, Quad{near - glm::dvec3(0, 0, thickness), {0, 8, 0}, {8, 0, 0}}});
    scene.camera = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 0.5};
    return scene;
}

struct Plate {
    const char* name;
    bool thin;
    float absorption;
    double expected;

    friend void PrintTo(const Plate& plate, std::ostream* out) { *out << plate.name; }
};

class PlateTest : public GlTest, public testing::WithParamInterface<Plate> { };

// Glass of index 1.5 reflects R = 0.04 at each side. Light that goes to and fro inside adds up to
// T = (1 - R)^2 A / (1 - R^2 A^2), where A is left after one way through.
TEST_P(PlateTest, TransmitsWhatItMust)
{
    const auto& [name, thin, absorption, expected] = GetParam();
    Material material = thin ? lossless::thin_glass(0) : lossless::glass(0);
    material.absorption = glm::vec3(absorption);
    const DeviceScene on_device(behind_plate(material, thin ? 0 : 0.7));
    const Estimate estimate = mean_of(picture(on_device, settings_of(24, 256)));
    EXPECT_NEAR(estimate.mean, expected, 5 * estimate.standard_error + 1e-5);
    EXPECT_LT(estimate.standard_error, 1e-3);
}

double through_plate(double left)
{
    const double r = 0.04;
    return (1 - r) * (1 - r) * left / (1 - r * r * left * left);
}

INSTANTIATE_TEST_SUITE_P(Glass, PlateTest,
    testing::Values(Plate{"Solid", false, 0, through_plate(1)},
        Plate{"ThinWalled", true, 0, 0.923077},
        Plate{"Absorbing", false, 1.5F, through_plate(std::exp(-1.5 * 0.7))}),
    [](const auto& test) { return test.param.name; });

/// A box of mirrors that reflect a fraction, with one wall that shines: every path meets mirrors
/// until it meets that wall, so each pixel is a power of the fraction.
TEST_F(GlTest, MirrorsFacingEachOtherMultiplyTheirReflectances)
{
    Scene scene;
    Material mirror = lossless::white(1, 0);
    mirror.albedo = glm::vec3(0.5F, 0.8F, 1);
    scene.materials = {{"light", glm::vec3(0), glm::vec3(1), true}, mirror};
    scene.objects.push_back({"above", 1, Quad{{-50, 1, -50}, {100, 0, 0}, {0, 0, 100}}});
    scene.objects.push_back({"below", 1, Quad{{-50, -1, -50}, {0, 0, 100}, {100, 0, 0}}});
    scene.objects.push_back({"end", 0, Quad{{20, -1, -50}, {0, 0, 100}, {0, 2, 0}}});
    // Looking along x and down by a slope: a reflection every 2 / slope.
    const double slope = 0.45;
    scene.camera = {{0, 0, 0}, {1, -slope, 0}, {0, 1, 0}, 0.2};
    const DeviceScene on_device(scene);
    const Image image = picture(on_device, settings_of(16, 1));
    // Unfolded, the ray is at height -20 * slope = -9 at the end: mirrors at -1, -3, -5, -7 and,
    // where the ray just reaches -9, the end itself comes first or last.
    const glm::vec3 middle = pixel(image, kPathExtent.width / 2, kPathExtent.height / 4);
    const double cosine = slope / std::hypot(1, slope);
    for (int c = 0; c < 3; ++c) {
        // glTF's conductors: Schlick's approximation from the albedo at a right angle.
        const double f0 = mirror.albedo[c];
        const double reflectance = f0 + (1 - f0) * std::pow(1 - cosine, 5);
        // 0.2 degrees of view change the cosine by up to 1e-3 on the way to this pixel.
        EXPECT_NEAR(middle[c], std::pow(reflectance, 4), 4e-3);
    }
}

/// The same light whether it is met by chance or sampled, on every kind of surface, over several
/// bounces.
TEST_F(GlTest, LightSamplingAgreesWithChanceOnAllMaterials)
{
    Scene scene;
    scene.materials = {{"light", glm::vec3(0), glm::vec3(3)}, lossless::white(),
        lossless::white(1, 0.4F), lossless::coated(lossless::plastic(0.3F), 0.3F),
        lossless::glass(0.4F), lossless::glass(0)};
    scene.materials[1].albedo = glm::vec3(0.5F);
    scene.objects.push_back({"lamp", 0, Quad{{-2, 3, -2}, {4, 0, 0}, {0, 0, 4}}});
    scene.objects.push_back({"floor", 1, Quad{{-6, -1, -6}, {0, 0, 12}, {12, 0, 0}}});
    for (int i = 0; i < 4; ++i)
        scene.objects.push_back(
            {"ball", 2U + static_cast<unsigned>(i), Sphere{{-2.7 + 1.8 * i, -0.2, 0}, 0.8}});
    scene.camera = {{0, 2, 6}, {0, -0.3, 0}, {0, 1, 0}, 50};
    const DeviceScene on_device(scene);
    Image images[2];
    for (const bool light_sampling : {false, true}) {
        RenderSettings s = settings_of(5, 512);
        s.light_sampling = light_sampling;
        images[light_sampling] = picture(on_device, s);
    }
    // The error of the difference: what both pictures show is no noise.
    const Estimate difference = mean_of(difference_of(images[0], images[1]));
    EXPECT_NEAR(difference.mean, 0, 5 * difference.standard_error);
    EXPECT_LT(difference.standard_error, 0.005 * mean_of(images[1]).mean);
}

/// A picture is the sum of its signals: with the filter off, svgf equals none to the bit, on
/// everything that has a signal of its own.
TEST_F(GlTest, SignalsAddUpToThePicture)
{
    Scene scene;
    scene.materials = {{"light", glm::vec3(0), glm::vec3(3)}, lossless::white(),
        lossless::white(1, 0.2F), lossless::coated(lossless::plastic(0.3F), 0), lossless::glass(0)};
    scene.objects.push_back({"lamp", 0, Quad{{-2, 3, -2}, {4, 0, 0}, {0, 0, 4}}});
    scene.objects.push_back({"floor", 1, Quad{{-6, -1, -6}, {0, 0, 12}, {12, 0, 0}}});
    for (int i = 0; i < 3; ++i)
        scene.objects.push_back(
            {"ball", 2U + static_cast<unsigned>(i), Sphere{{-2.0 + 2.0 * i, -0.2, 0}, 0.8}});
    scene.medium.sigma_s = glm::vec3(0.02F);
    scene.camera = {{0, 2, 6}, {0, -0.3, 0}, {0, 1, 0}, 50};
    const DeviceScene on_device(scene);
    const auto render = [&](Denoiser denoiser) {
        RenderSettings s;
        s.denoiser = denoiser;
        s.atrous_iterations = 0;
        return picture(on_device, s).bytes;
    };
    EXPECT_EQ(render(Denoiser::kSvgf), render(Denoiser::kOff));
}

/// Many samples in one frame are the same samples as few in many frames: none is cut short, though
/// llvmpipe ends all loops of an invocation after 65535 rounds together.
TEST_F(GlTest, ManySamplesInOneFrameAreAllTraced)
{
    Scene scene;
    scene.materials = {lossless::white(), lossless::white()};
    scene.materials[0] = lossless::glass(0);
    scene.materials[1].albedo = glm::vec3(0.9F);
    for (int i = 0; i < 8; ++i)  // one within the other: a path meets many surfaces
        scene.objects.push_back({"shell", 0, Sphere{{0, 0, 0}, 1.0 - 0.1 * i}});
    scene.objects.push_back({"floor", 1, Quad{{-3, -1.1, -3}, {0, 0, 6}, {6, 0, 0}}});
    scene.background = glm::vec3(1);
    scene.medium.sigma_s = glm::vec3(0.05F);
    scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 40};
    const DeviceScene on_device(scene);
    View one(on_device.shared);
    View many(on_device.shared);
    const Extent extent{16, 16};
    const Image at_once = one.render(linear_request(scene, extent, settings_of(24, 256))).image;
    RenderedFrame last;
    for (int i = 0; i < 32; ++i)
        last = many.render(linear_request(scene, extent, settings_of(24, 8)));
    for (int i = 0; i < extent.width * extent.height; ++i) {
        const glm::vec3 expected = pixel(last.image, i % extent.width, i / extent.width);
        const glm::vec3 found = pixel(at_once, i % extent.width, i / extent.width);
        // 1e-4: sums of 256 numbers in another order.
        EXPECT_LT(glm::length(found - expected), 1e-4F * glm::length(expected)) << i;
    }
}

/// Where nothing can scatter light, no path is traced and nothing filtered.
TEST_F(GlTest, NothingIsTracedWhereNothingScatters)
{
    Scene black;
    black.materials = {{"black", glm::vec3(0), glm::vec3(1)}};
    black.objects.push_back({"ball", 0, Sphere{}});
    Scene dark;
    dark.materials = {lossless::white()};
    dark.objects.push_back({"ball", 0, Sphere{}});
    Scene unlit;
    unlit.materials = {lossless::white()};
    unlit.materials[0].unlit = true;
    unlit.objects.push_back({"ball", 0, Sphere{}});
    for (auto& [scene, expected] :
        std::vector<std::pair<Scene, float>>{{black, 1.0F}, {dark, 0.0F}, {unlit, 1.0F}}) {
        scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 40};
        const DeviceScene on_device(scene);
        View view(on_device.shared);
        const Image image = view.render(linear_request(scene, kPathExtent, {})).image;
        for (const std::string& pass : view.graph().pass_names())
            EXPECT_TRUE(pass == "gbuffer" || pass.starts_with("composite")) << pass;
        EXPECT_EQ(pixel(image, 24, 24), glm::vec3(expected));
    }
}

}  // namespace
}  // namespace farlight
