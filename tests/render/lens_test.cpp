// The thin lens, and where in its pixel a ray looks.
#include "lab/statistics.h"
#include "server/render/camera.h"
#include "tests/support/gl_test.h"

namespace farlight {
namespace {

constexpr Extent kLensExtent{96, 96};
constexpr double kFocus = 4;

/// A square that shines, `half` wide to either side of the axis, at view depth z.
Scene lamp_at(double z, double half, double lens_radius)
{
    Scene scene;
    scene.materials.push_back({"light", glm::vec3(0), glm::vec3(1)});
    scene.objects.push_back(
        {"lamp", 0, Quad{{-half, -half, -z}, {2 * half, 0, 0}, {0, 2 * half, 0}}});
    scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 30};
    scene.lens = {lens_radius, kFocus};
    return scene;
}

Image mean_emission(const Scene& scene, int frames, bool antialiasing)
{
    const DeviceScene on_device(scene);
    View view(on_device.shared);
    RenderSettings s;
    s.denoiser = Denoiser::kAccumulate;
    s.antialiasing = antialiasing;
    s.max_depth = 1;
    const RenderRequest request = linear_request(scene, kLensExtent, s);
    RenderedFrame frame;
    for (int i = 0; i < frames; ++i)
        frame = view.render(request);
    return std::move(frame.image);
}

struct Moments {
    double sum = 0;
    double radius2 = 0;  ///< Mean square distance from the picture's middle [px^2].
};

Moments moments_of(const Image& image)
{
    Moments m;
    for (int y = 0; y < kLensExtent.height; ++y)
        for (int x = 0; x < kLensExtent.width; ++x) {
            const double value = pixel(image, x, y).x;
            const double dx = x + 0.5 - kLensExtent.width / 2.0;
            const double dy = y + 0.5 - kLensExtent.height / 2.0;
            m.sum += value;
            m.radius2 += value * (dx * dx + dy * dy);
        }
    m.radius2 /= m.sum;
    return m;
}

struct Blur {
    const char* name;
    double depth;
    double lens_radius;

    friend void PrintTo(const Blur& blur, std::ostream* out) { *out << blur.name; }
};

class LensTest : public GlTest, public testing::WithParamInterface<Blur> { };

// Out of focus a point at depth z becomes a disc of radius R |z - F| / z in the plane of focus. A
// disc of radius r has the mean square radius r^2 / 2, and blurring adds mean squares.
TEST_P(LensTest, BlursToTheRadiusOfItsGeometryAndLosesNothing)
{
    const auto& [name, depth, lens_radius] = GetParam();
    const double half = 0.05 * depth;
    const Moments sharp = moments_of(mean_emission(lamp_at(depth, half, 0), 1, false));
    const Moments blurred =
        moments_of(mean_emission(lamp_at(depth, half, lens_radius), 256, false));
    const double footprint = camera_constants(lamp_at(1, 1, 0).camera, kLensExtent).pixel_footprint;
    const double radius =
        lens_radius * std::abs(depth - kFocus) / depth / (footprint * kFocus);  // [px]
    ASSERT_GT(radius, 4) << "too little to measure";
    ASSERT_LT(radius, 30) << "runs out of the picture";
    // About 290 lamp pixels times 256 frames of lens samples: a relative error of 1/270 for the
    // sum, which stands for 5 of them, and as much again for the square radius.
    EXPECT_NEAR(blurred.sum / sharp.sum, 1, 0.02);
    EXPECT_NEAR(blurred.radius2 - sharp.radius2, radius * radius / 2, 0.03 * radius * radius / 2);
}

INSTANTIATE_TEST_SUITE_P(Depths, LensTest,
    testing::Values(Blur{"BehindTheFocus", 8, 0.4}, Blur{"FarBehind", 40, 0.25},
        Blur{"BeforeTheFocus", 2, 0.15}, Blur{"WideOpen", 6, 0.8}),
    [](const auto& test) { return test.param.name; });

/// In the plane of focus every ray of a pixel meets the same point.
TEST_F(GlTest, PlaneOfFocusIsSharp)
{
    const Image sharp = mean_emission(lamp_at(kFocus, 0.5, 0), 1, false);
    const Image focused = mean_emission(lamp_at(kFocus, 0.5, 0.8), 16, false);
    for (int y = 0; y < kLensExtent.height; ++y)
        for (int x = 0; x < kLensExtent.width; ++x)
            ASSERT_EQ(pixel(focused, x, y), pixel(sharp, x, y)) << x << "," << y;
}

/// Without a focus distance the camera's target is sharp, wherever it is.
TEST_F(GlTest, LensFocusesOnTheTarget)
{
    Scene scene = lamp_at(7, 0.9, 0.5);
    scene.lens.focus_distance = 0;
    scene.camera.target = {0, 0, -7};
    Scene pinhole = scene;
    pinhole.lens.radius = 0;
    const Image focused = mean_emission(scene, 8, false);
    const Image sharp = mean_emission(pinhole, 1, false);
    EXPECT_EQ(focused.bytes, sharp.bytes);
}

/// Lens samples are part of the G-buffer: a resting camera still has exactly no motion.
TEST_F(GlTest, OutOfFocusARestingCameraHasNoMotion)
{
    const DeviceScene on_device(lamp_at(8, 2, 0.5));
    View view(on_device.shared);
    RenderSettings s;
    s.view = DebugView::kMotion;
    const RenderRequest request = linear_request(on_device.scene, kLensExtent, s);
    view.render(request);
    const Image motion = view.render(request).image;
    for (int y = 0; y < kLensExtent.height; ++y)
        for (int x = 0; x < kLensExtent.width; ++x)
            ASSERT_EQ(pixel(motion, x, y), glm::vec3(0)) << x << "," << y;
}

/// Where samples are averaged a pixel shows the mean over its area: an edge across a pixel covers
/// part of it.
TEST_F(GlTest, AveragedPixelsAreAntialiased)
{
    const double footprint = camera_constants(lamp_at(1, 1, 0).camera, kLensExtent).pixel_footprint;
    for (const double edge : {10.05, 10.25, 10.6, 10.8}) {
        const Scene scene = lamp_at(1, edge * footprint, 0);
        const Image smooth = mean_emission(scene, 256, true);
        const Image stepped = mean_emission(scene, 2, false);
        const int x = kLensExtent.width / 2 + 10;  // the pixel from 10 to 11
        const int y = kLensExtent.height / 2;
        // Halton points: 256 of them measure a half-plane to better than log(256) / 256.
        EXPECT_NEAR(pixel(smooth, x, y).x, edge - 10, 0.02) << edge;
        EXPECT_NEAR(pixel(smooth, x - 1, y).x, 1, 1e-5);
        EXPECT_NEAR(pixel(smooth, x + 1, y).x, 0, 1e-5);
        EXPECT_EQ(pixel(stepped, x, y).x, edge > 10.5 ? 1 : 0) << edge;
    }
}

}  // namespace
}  // namespace farlight
