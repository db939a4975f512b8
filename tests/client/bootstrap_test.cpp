// Medians, and intervals that hold what they should.
#include "client/metrics/bootstrap.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

using namespace client;

TEST(Median, OfOddAndEvenCounts)
{
    EXPECT_EQ(median({}), 0);
    EXPECT_EQ(median({3}), 3);
    EXPECT_EQ(median({9, 1, 2}), 2);
    EXPECT_EQ(median({4, 1, 9, 2}), 3);
}

TEST(RatioOfMedians, IsExactWithoutNoise)
{
    const RatioOfMedians r = ratio_of_medians({2, 2, 2}, {4, 4, 4});
    EXPECT_EQ(r.ratio, 0.5);
    EXPECT_EQ(r.interval.lower, 0.5);
    EXPECT_EQ(r.interval.upper, 0.5);
}

/// Of 400 intervals of 95 % about 380 hold the truth; with standard deviation sqrt(400 * 0.05 *
/// 0.95) = 4.4 at least 350 do but for a chance below 1e-9, even if the bootstrap of 40 pairs is a
/// point optimistic. A factor that both times share, as another program's, must not widen them.
TEST(RatioOfMedians, TheIntervalHoldsTheTruth)
{
    std::mt19937 random(3);
    std::lognormal_distribution<double> noise(0, 0.05);
    std::lognormal_distribution<double> shared(0, 0.5);
    int held = 0;
    double width = 0;
    for (int run = 0; run < 400; ++run) {
        std::vector<double> a;
        std::vector<double> b;
        for (int i = 0; i < 40; ++i) {
            const double load = i % 8 == 0 ? shared(random) : 1;
            a.push_back(0.9 * load * noise(random));
            b.push_back(load * noise(random));
        }
        const RatioOfMedians r = ratio_of_medians(a, b);
        held += r.interval.lower <= 0.9 && 0.9 <= r.interval.upper ? 1 : 0;
        width += (r.interval.upper - r.interval.lower) / 400;
    }
    EXPECT_GE(held, 350);
    EXPECT_LT(width, 0.08);
}

}  // namespace
}  // namespace farlight
