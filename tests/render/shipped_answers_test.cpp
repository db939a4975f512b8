// The known answers of scenes/README.md, through the whole renderer.
//
// Seeds are fixed, so the tests are deterministic; the bounds are 5 standard errors, which a fresh
// seed would exceed by chance once in 1.7 million. What an answer's own note adds is said there.
#include "tests/support/gl_test.h"

#include <cmath>

namespace farlight {
namespace {

struct Answer {
    const char* name;
    const char* scene;
    CameraPose camera;  ///< Looks at what the answer is about and at little else.
    int max_depth;
    glm::dvec3 expected;
    double tolerance = 1e-5;  ///< Relative, besides chance: some ulps a segment.

    friend void PrintTo(const Answer& answer, std::ostream* out) { *out << answer.scene; }
};

constexpr double kNarrow = 0.05;  // [degrees]: a spot of a thousandth of its distance
const CameraPose kWhole{{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 40};

/// At a panel of absorbing_fog.json, `distance` from the camera at the origin.
Answer ink(const char* name, const glm::dvec3& at)
{
    const double d = glm::length(at);
    return {name, "absorbing_fog.json", {{0, 0, 0}, at, {0, 1, 0}, kNarrow}, 2,
        glm::exp(-d * glm::dvec3(0.1, 0.2, 0.4)), 1e-3};  // the spot's own depth in the ink
}

const Answer kAnswers[] = {
    {"WhiteFurnace", "white_furnace.json", kWhole, 2, glm::dvec3(1)},
    {"WhiteFurnaceLongPaths", "white_furnace.json", kWhole, 8, glm::dvec3(1)},
    {"GlassFurnace", "glass_furnace.json", kWhole, 64, glm::dvec3(1)},
    {"PointFurnaceDirect", "point_furnace.json", {{0.3, 0.2, 0.5}, {0, 0, -0.4}, {0, 1, 0}, 60}, 2,
        glm::dvec3(0.5)},
    {"PointFurnace", "point_furnace.json", {{0.3, 0.2, 0.5}, {0, 0, -0.4}, {0, 1, 0}, 60}, 5,
        glm::dvec3(0.9375)},
    {"UnderTheDisk", "disk_light.json", {{0, 0.8, 3}, {0, 0, 0}, {0, 1, 0}, kNarrow}, 2,
        glm::dvec3(0.2)},
    // A sky of 32 rows: within a row the map does not follow y.
    {"LinearSkyAbove", "linear_sky.json", {{0, 4, 0}, {0, 1, 0}, {0, 0, 1}, kNarrow}, 2,
        glm::dvec3(0.5 * (1 + 0.8 * 2 / 3)), 2e-3},
    {"LinearSkyAside", "linear_sky.json", {{0, 0, 4}, {0, 0, 1}, {0, 1, 0}, kNarrow}, 2,
        glm::dvec3(0.5), 2e-3},
    {"LinearSkyBelow", "linear_sky.json", {{0, -4, 0}, {0, -1, 0}, {0, 0, 1}, kNarrow}, 2,
        glm::dvec3(0.5 * (1 - 0.8 * 2 / 3)), 2e-3},
    ink("NearInk", {-0.85, 0, -2}),
    ink("MiddleInk", {0, 0, -4}),
    ink("FarInk", {2.3, 0, -6}),
};

class ShippedAnswersTest : public GlTest, public testing::WithParamInterface<Answer> { };

TEST_P(ShippedAnswersTest, IsWhatTheReadmeSays)
{
    const Answer& answer = GetParam();
    Scene scene = shipped_scene(answer.scene);
    scene.camera = answer.camera;
    const DeviceScene on_device(scene);
    RenderSettings s;
    s.denoiser = Denoiser::kAccumulate;
    s.max_depth = answer.max_depth;
    s.samples_per_pixel = 64;
    constexpr Extent kAnswerExtent{48, 32};
    View view(on_device.shared);
    const RenderedFrame frame = view.render(linear_request(on_device.scene, kAnswerExtent, s));
    EXPECT_EQ(frame.bad_values.all(), 0U);
    glm::dvec3 sum(0);
    glm::dvec3 squares(0);
    for (int y = 0; y < kAnswerExtent.height; ++y)
        for (int x = 0; x < kAnswerExtent.width; ++x) {
            const glm::dvec3 value = pixel(frame.image, x, y);
            sum += value;
            squares += value * value;
        }
    const double count = kAnswerExtent.width * kAnswerExtent.height;
    for (int channel = 0; channel < 3; ++channel) {
        const double mean = sum[channel] / count;
        const double variance = std::max(0.0, squares[channel] / count - mean * mean);
        const double expected = answer.expected[channel];
        EXPECT_NEAR(mean, expected, 5 * std::sqrt(variance / count) + answer.tolerance * expected)
            << channel;
        EXPECT_LT(std::sqrt(variance / count), 0.01 * expected) << "too noisy to tell";
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedAnswersTest, testing::ValuesIn(kAnswers),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace farlight
