// Metrics with values worked out by hand.
#include "client/metrics/metrics.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace farlight {
namespace {

using namespace client;
using testing::HasSubstr;
using testing::ThrowsMessage;
using Values = std::vector<float>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Metrics, EqualPicturesHaveNoError)
{
    const Values x{0, 1, 2, 65504, 1e-20F, 3};
    EXPECT_EQ(relative_mse(x, x), 0);
    EXPECT_EQ(root_mean_square_error(x, x), 0);
}

TEST(Metrics, ClosedValues)
{
    const Values test{1, 3, 0};
    const Values reference{0, 1, 0};
    // (1/0.01 + 4/1.01 + 0) / 3 and sqrt((1 + 4 + 0) / 3)
    EXPECT_NEAR(relative_mse(test, reference), (100 + 4 / 1.01) / 3, 1e-12);
    EXPECT_NEAR(root_mean_square_error(test, reference), 1.2909944487358056, 1e-15);
    EXPECT_NEAR(mean_value(test), 4.0 / 3, 1e-15);
    EXPECT_EQ(largest_value(test), 3);
}

TEST(Metrics, TheErrorIsRelativeToTheReferenceNotTheTest)
{
    EXPECT_NE(relative_mse(Values{2}, Values{1}), relative_mse(Values{1}, Values{2}));
    EXPECT_NEAR(relative_mse(Values{2}, Values{1}), 1 / 1.01, 1e-12);
}

TEST(Metrics, SumsDoNotLoseSmallTerms)
{
    Values reference(1'000'001, 0.0F);
    Values test(1'000'001, 0.001F);
    test[0] = 1000;
    const double expected =
        (1e6 + 1e6 * static_cast<double>(0.001F) * static_cast<double>(0.001F)) / 1'000'001;
    EXPECT_NEAR(root_mean_square_error(test, reference), std::sqrt(expected),
        1e-10);  // a million roundings of a sum of a million
}

TEST(Metrics, NonFiniteValuesFailBeforeAnythingIsAveraged)
{
    const Values good{1, 1};
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        const Values test{1, bad};
        EXPECT_EQ(count_nonfinite(test), 1U);
        EXPECT_THAT([&] { relative_mse(test, good); },
            ThrowsMessage<MetricError>(HasSubstr("1 of 2 values of the picture are not finite")));
        EXPECT_THAT([&] { root_mean_square_error(good, test); },
            ThrowsMessage<MetricError>(HasSubstr("of the reference are not finite")));
        EXPECT_THROW(mean_value(test), MetricError);
        EXPECT_THROW(largest_value(test), MetricError);
    }
}

TEST(Metrics, DifferentOrNoSizesAreRefused)
{
    EXPECT_THROW(relative_mse(Values{1, 2}, Values{1}), MetricError);
    EXPECT_THROW(relative_mse(Values{}, Values{}), MetricError);
    EXPECT_THROW(mean_value(Values{}), MetricError);
}

TEST(Metrics, TheOtherMeansHaveClosedValuesToo)
{
    const Values test{1, 3, 0};
    const Values reference{0, 1, 0};
    EXPECT_NEAR(mean_square_error(test, reference), 5.0 / 3, 1e-12);
    EXPECT_NEAR(smape(test, reference), (2 / 1.01 + 4 / 4.01) / 3, 1e-12);
    EXPECT_EQ(smape(reference, reference), 0);
    // mean (X - R)^2 of 0.01 is 20 dB
    EXPECT_NEAR(peak_signal_to_noise(Values{0.5F, 0.5F}, Values{0.6F, 0.4F}), 20, 1e-5);
    EXPECT_EQ(peak_signal_to_noise(test, test), std::numeric_limits<double>::infinity());
}

/// 3000 pixels of which 4 are far off: 3 of them are the worst 0.1 %.
TEST(Metrics, TheWorstPixelsAreLeftOutOfRelMse999AndCountedAsFireflies)
{
    Values reference(9000, 1.0F);
    Values test(9000, 1.1F);
    for (const std::size_t i : {0U, 300U, 3001U, 8999U})
        test[i] = 100;
    const double away = static_cast<double>(1.1F) - 1;
    const double small = away * away / 1.01;
    const double large = 99 * 99 / 1.01;
    EXPECT_NEAR(relative_mse(test, reference), (4 * large + 8996 * small) / 9000, 1e-9);
    EXPECT_NEAR(
        relative_mse_999(test, reference), ((large + 2 * small) / 3 + 2996 * small) / 2997, 1e-9);
    EXPECT_EQ(count_fireflies(test, reference), 4);
    EXPECT_EQ(count_fireflies(Values{11, 11, 11}, Values{1, 1, 1}), 0);  // not above 10 (1 + 0.1)
    EXPECT_EQ(relative_mse_999(Values{2, 1, 1}, Values{1, 1, 1}), 1 / 1.01 / 3);
}

/// The upper half is sky that is left out, full of what must not be looked at.
TEST(Metrics, HalfSkyHasTheErrorOfItsCrop)
{
    const std::size_t half = 3000;
    Values test(2 * half, kNan);
    Values reference(2 * half, 5.0F);
    for (std::size_t i = half; i < 2 * half; ++i) {
        test[i] = static_cast<float>(i % 7);
        reference[i] = static_cast<float>(i % 5);
    }
    std::vector<std::uint8_t> ground(2 * half / 3, 0);
    std::fill(ground.begin() + half / 3, ground.end(), std::uint8_t{1});
    const Values test_crop(test.begin() + half, test.end());
    const Values reference_crop(reference.begin() + half, reference.end());
    for (const auto metric : {relative_mse, relative_mse_999, mean_square_error,
             root_mean_square_error, smape, count_fireflies, peak_signal_to_noise})
        EXPECT_EQ(metric(test, reference, ground), metric(test_crop, reference_crop, {}));
    EXPECT_THROW(relative_mse(test, reference), MetricError);
    EXPECT_THROW(relative_mse(test_crop, reference_crop, ground), MetricError);
    EXPECT_THROW(
        relative_mse(test, reference, std::vector<std::uint8_t>(ground.size(), 0)), MetricError);
}

TEST(Metrics, APixelIsLitByAnyChannel)
{
    EXPECT_EQ(share_lit(Values{0, 0, 0, 0, 0, 1e-30F}), 0.5);
    EXPECT_EQ(share_lit(Values{kNan, -1, 0}), 0);
    EXPECT_EQ(share_lit(Values{}), 0);
}

}  // namespace
}  // namespace farlight
