// Flicker, lag and ghosts of sequences made up to have a known answer.
#include "client/metrics/temporal.h"

#include "tests/client/synthetic_pictures.h"

#include <gmock/gmock.h>
#include <limits>

namespace farlight {
namespace {

using namespace client;
using Values = std::vector<float>;

TEST(Flicker, OfABlinkingPixelBesideASteadyOne)
{
    FlickerMeter meter;
    for (int frame = 0; frame < 4; ++frame) {
        const float blink = frame % 2 == 0 ? 1.0F : 3.0F;
        meter.add(Values{blink, blink, blink, 2, 2, 2});
    }
    // The first pixel: mean 2, deviation sqrt(4 / 3), a step of 2 from frame to frame.
    EXPECT_EQ(meter.frames(), 4);
    EXPECT_NEAR(meter.flicker(), std::sqrt(4.0 / 3) / 2.01 / 2, 1e-12);
    EXPECT_NEAR(meter.successive_difference(), 1, 1e-12);
    const std::vector<std::uint8_t> steady{0, 1};
    EXPECT_NEAR(meter.flicker(steady), 0, 1e-12);
    const std::vector<std::uint8_t> blinking{1, 0};
    EXPECT_NEAR(meter.successive_difference(blinking), 2, 1e-12);
}

TEST(Flicker, OfBrightFramesKeepsSmallUnrest)
{
    FlickerMeter meter;
    for (int frame = 0; frame < 64; ++frame) {
        const float value = 65536 + 0.0625F * static_cast<float>(frame % 2);
        meter.add(Values{value, value, value});
    }
    EXPECT_NEAR(meter.flicker() * 65536.04125, 0.03125 * std::sqrt(64.0 / 63), 1e-9);
}

TEST(Flicker, RefusesOneFrameOtherSizesAndNan)
{
    FlickerMeter meter;
    meter.add(Values{1, 1, 1});
    EXPECT_THROW(meter.flicker(), MetricError);
    EXPECT_THROW(meter.add(Values{1, 1, 1, 1, 1, 1}), MetricError);
    EXPECT_THROW(meter.add(Values{1, 1, std::numeric_limits<float>::quiet_NaN()}), MetricError);
    meter.add(Values{1, 1, 1});
    EXPECT_EQ(meter.flicker(), 0);
    EXPECT_THROW(meter.flicker(std::vector<std::uint8_t>{0}), MetricError);
    EXPECT_THROW(meter.flicker(std::vector<std::uint8_t>{1, 1}), MetricError);
}

/// An exponential mean that takes in a fifth of each frame: its error after a step is 0.8^(2 n) of
/// the step's, above a floor. It is below twice the floor when 0.8^(2 n) < floor.
TEST(Lag, OfAnExponentialMean)
{
    const double floor = 1e-3;
    std::vector<double> errors;
    for (int n = 0; n < 60; ++n)
        errors.push_back(floor + std::pow(0.8, 2 * n));
    EXPECT_EQ(lag_frames(errors), static_cast<int>(std::ceil(std::log(floor) / std::log(0.64))));
    EXPECT_NEAR(residual(errors, 4), std::pow(0.8, 8), 2e-3);
    EXPECT_THROW(residual(errors, 60), MetricError);
}

TEST(Lag, IsNoneWhereTheFirstFrameIsAsGoodAsTheLast)
{
    EXPECT_EQ(lag_frames(std::vector<double>{1.9, 1, 1}), 0);
    EXPECT_EQ(lag_frames(std::vector<double>{2, 1, 1}), 1);
    EXPECT_EQ(lag_frames(std::vector<double>{0.5, 0}), 2);  // nothing is below twice 0
    EXPECT_THROW(lag_frames({}), MetricError);
}

TEST(Ghost, IsTheLargestOfTheRevealedPixelsOnly)
{
    const Values reference{1, 1, 1, 2, 2, 2, 0, 0, 0};
    const Values test{9, 9, 9, 2, 3, 1, 0, 0, 0.02F};
    const std::vector<std::uint8_t> revealed{0, 1, 1};
    EXPECT_NEAR(ghost_residue(test, reference, revealed), 2, 1e-6);
    const std::vector<std::uint8_t> middle{0, 1, 0};
    EXPECT_NEAR(ghost_residue(test, reference, middle), 1 / 2.01, 1e-12);
    EXPECT_THROW(ghost_residue(test, reference, {}), MetricError);
    EXPECT_THROW(ghost_residue(test, reference, std::vector<std::uint8_t>{0, 0, 0}), MetricError);
}

}  // namespace
}  // namespace farlight
