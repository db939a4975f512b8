// Display values of the client: published points of both curves. tests/shaders compares them with
// the shader's.
#include "client/metrics/display.h"

#include <gtest/gtest.h>
#include <limits>

namespace farlight {
namespace {

using namespace client;

TEST(Display, CurvesPassThroughTheirPublishedPoints)
{
    EXPECT_NEAR(srgb_encode(0.21404114), 0.5, 1e-8);
    EXPECT_NEAR(srgb_encode(1), 1, 1e-15);
    EXPECT_NEAR(srgb_decode(0.5), 0.21404114, 1e-8);
    for (int i = 0; i <= 255; ++i)
        EXPECT_NEAR(srgb_encode(srgb_decode(i / 255.0)), i / 255.0, 1e-6);  // the joint is rounded
    EXPECT_NEAR(
        aces_curve(0.5), 0.5 * (2.51 * 0.5 + 0.03) / (0.5 * (2.43 * 0.5 + 0.59) + 0.14), 1e-15);
    EXPECT_EQ(aces_curve(0), 0);
    EXPECT_EQ(aces_curve(std::numeric_limits<double>::infinity()), 1);
    EXPECT_EQ(aces_curve(-1), 0);
    EXPECT_EQ(aces_curve(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Display, ExposureComesBeforeTheCurve)
{
    const std::vector<float> linear{0.25F, 4, -1};
    const auto bright = display_of_linear(linear, {.exposure = 2});
    EXPECT_NEAR(bright[0], srgb_encode(aces_curve(0.5)), 1e-7);
    EXPECT_EQ(bright[2], 0);
    const auto clipped = display_of_linear(linear, {.exposure = 2, .curve = ToneCurve::kLinear});
    EXPECT_NEAR(clipped[0], srgb_encode(0.5), 1e-7);
    EXPECT_EQ(clipped[1], 1);
}

TEST(Display, BytesDecodeBothWays)
{
    const std::vector<std::uint8_t> bytes{0, 128, 255};
    EXPECT_EQ(display_of_bytes(bytes)[1], 128.0F / 255);
    EXPECT_NEAR(linear_of_bytes(bytes)[1], srgb_decode(128.0 / 255), 1e-7);
    EXPECT_EQ(linear_of_bytes(bytes)[2], 1);
}

}  // namespace
}  // namespace farlight
