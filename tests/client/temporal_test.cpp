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

/// A light that moves is no unrest, what a frame adds to it is.
TEST(Flicker, OfFramesAboutAMovingTruth)
{
    FlickerMeter true_to_it;
    FlickerMeter blinking;
    for (int frame = 0; frame < 4; ++frame) {
        const float truth = 1.0F + static_cast<float>(frame);  // mean 2.5
        const float blink = truth + (frame % 2 == 0 ? 0.5F : -0.5F);
        true_to_it.add(Values{truth, truth, truth}, Values{truth, truth, truth});
        blinking.add(Values{blink, blink, blink}, Values{truth, truth, truth});
    }
    EXPECT_NEAR(true_to_it.flicker(), 0, 1e-12);
    EXPECT_NEAR(true_to_it.successive_difference(), 0, 1e-12);
    EXPECT_NEAR(blinking.flicker(), std::sqrt(4 * 0.25 / 3) / 2.51, 1e-12);
    EXPECT_NEAR(blinking.successive_difference(), 1, 1e-12);
    EXPECT_THROW(blinking.add(Values{1, 1, 1}, Values{1, 1}), MetricError);
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
    std::vector<double> errors(60);
    for (int n = 0; n < 60; ++n)
        errors[n] = floor + std::pow(0.8, 2 * n);
    EXPECT_EQ(lag_frames(errors), static_cast<int>(std::ceil(std::log(floor) / std::log(0.64))));
    EXPECT_NEAR(residual(errors, 4), std::pow(0.8, 8), 2e-3);
    EXPECT_THROW(residual(errors, 60), MetricError);
}

TEST(Lag, IsNoneWhereTheFirstFrameIsAsGoodAsTheLast)
{
    EXPECT_EQ(lag_frames(std::vector<double>{1.9, 1, 1}), 0);
    EXPECT_EQ(lag_frames(std::vector<double>{2, 1, 1}), 1);  // twice is not below twice
    EXPECT_EQ(lag_frames(std::vector<double>{2, std::nextafter(2.0, 0), 1}), 1);
    EXPECT_EQ(lag_frames(std::vector<double>{0.5, 0}), 1);  // a light that went out
    EXPECT_THROW(lag_frames({}), MetricError);
}

/// A near square, 4 pixels wide, moves 3 to the right in front of a floor that is steep to the eye:
/// columns 6 to 8 come out.
TEST(Ghost, RevealedIsWhatANearerSurfaceHid)
{
    const ImageSize size{20, 12};
    const auto depth_of = [&](int left) {
        return synthetic_picture(
            [=](int x, int y, int) {
                const bool near = x >= left && x < left + 4 && y >= 3 && y < 9;
                return near ? 1.0 : 10.0 + y;
            },
            size);
    };
    const auto motion = synthetic_picture(
        [](int x, int y, int c) {
            return c == 0 && x >= 9 && x < 13 && y >= 3 && y < 9 ? -3.0 : 0.0;
        },
        size);
    const auto revealed = newly_revealed(depth_of(9), motion, depth_of(6), size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            EXPECT_EQ(revealed[y * 20 + x] != 0, x >= 6 && x < 9 && y >= 3 && y < 9)
                << x << ", " << y;
    // Half a pixel beside the square its floor was read together with the floor that was seen.
    auto shifted = motion;
    for (std::size_t i = 0; i < shifted.size(); i += 3)
        shifted[i] -= 0.5F;
    const auto fewer = newly_revealed(depth_of(9), shifted, depth_of(6), size);
    EXPECT_EQ(fewer[5 * 20 + 6], 0);
    EXPECT_EQ(fewer[5 * 20 + 7], 1);
    const std::vector<float> still(size.pixels() * 3, 0.0F);
    for (const auto pixel : newly_revealed(depth_of(9), still, depth_of(9), size))
        EXPECT_EQ(pixel, 0);
    EXPECT_THROW(newly_revealed(depth_of(9), still, Values(3), size), MetricError);
}

/// What comes in from beyond the border, and where nothing is, is not counted; the sky hides
/// nothing.
TEST(Ghost, NeitherTheBorderNorTheSkyReveals)
{
    const ImageSize size{6, 6};
    const std::vector<float> near(size.pixels() * 3, 1.0F);
    const std::vector<float> far(size.pixels() * 3, 5.0F);
    const std::vector<float> none(size.pixels() * 3, 0.0F);
    const std::vector<float> out(size.pixels() * 3, 9.0F);
    const auto count = [&](const Values& now, const Values& motion, const Values& before) {
        const auto revealed = newly_revealed(now, motion, before, size);
        return std::count(revealed.begin(), revealed.end(), 1);
    };
    EXPECT_EQ(count(far, none, near), 36);
    EXPECT_EQ(count(far, out, near), 0);
    EXPECT_EQ(count(none, none, near), 0);
    EXPECT_EQ(count(far, none, none), 0);
    EXPECT_EQ(count(near, none, far), 0);
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
