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

TEST(Metrics, APixelIsLitByAnyChannel)
{
    EXPECT_EQ(share_lit(Values{0, 0, 0, 0, 0, 1e-30F}), 0.5);
    EXPECT_EQ(share_lit(Values{kNan, -1, 0}), 0);
    EXPECT_EQ(share_lit(Values{}), 0);
}

}  // namespace
}  // namespace farlight
