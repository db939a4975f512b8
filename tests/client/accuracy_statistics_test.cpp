// Frontier, prices, fits and crossings, with answers worked out by hand or by construction.
#include "client/accuracy/fit.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>

namespace farlight {
namespace {

using namespace client;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

TEST(Frontier, KeepsWhatNothingBeats)
{
    //                                      beaten      by 0        kept     by 3
    const std::vector<TimedError> points{{1, 8}, {2, 8}, {3, 9}, {2, 4}, {4, 4}};
    EXPECT_THAT(pareto_frontier(points), ElementsAre(0U, 3U));
}

TEST(Frontier, OfEqualPointsTheFirstStays)
{
    EXPECT_THAT(pareto_frontier({{1, 2}, {1, 2}, {1, 1}, {1, 1}}), ElementsAre(2U));
}

TEST(Frontier, LeavesOutWhatIsNoMeasurement)
{
    EXPECT_THAT(
        pareto_frontier({{1, kNothing}, {kNothing, 1}, {0, 1}, {1, 0}, {1, -1}}), IsEmpty());
    EXPECT_THAT(pareto_frontier({}), IsEmpty());
}

TEST(Frontier, HoldsNoDominatedPointAndMissesNone)
{
    std::mt19937 random(3);
    // Few values, so that many points tie.
    std::uniform_int_distribution<int> pick(1, 12);
    for (int round = 0; round < 100; ++round) {
        std::vector<TimedError> points;
        for (int i = 0; i < 40; ++i)
            points.push_back({double(pick(random)), double(pick(random))});
        const auto frontier = pareto_frontier(points);
        const auto beats = [&](std::size_t a, std::size_t b) {
            return points[a].ms <= points[b].ms && points[a].error <= points[b].error
                && (points[a].ms < points[b].ms || points[a].error < points[b].error);
        };
        for (std::size_t i = 1; i < frontier.size(); ++i) {
            EXPECT_LT(points[frontier[i - 1]].ms, points[frontier[i]].ms);
            EXPECT_GT(points[frontier[i - 1]].error, points[frontier[i]].error);
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool beaten = false;
            for (std::size_t k = 0; k < points.size(); ++k)
                beaten = beaten || beats(k, i);
            bool on = false;
            for (const std::size_t k : frontier)
                on = on || (points[k].ms == points[i].ms && points[k].error == points[i].error);
            EXPECT_EQ(on, !beaten) << "point " << i << " of round " << round;
        }
    }
}

TEST(Fit, LeavesOutWhatIsNoMeasurement)
{
    const std::vector<TimedError> nothing{{1, 0}, {2, 0}, {0, 1}, {3, kNothing}};
    EXPECT_FALSE(fit_error(nothing, 0));
    EXPECT_FALSE(fit_error(nothing));
    EXPECT_FALSE(log_slope(nothing));
    EXPECT_DOUBLE_EQ(*log_slope({{1, 4}, {2, 0}, {4, 1}}), -1);
    EXPECT_DOUBLE_EQ(fit_error({{1, 0}, {2, 3}}, 0)->rate, 6);
}

TEST(Prices, GoToTheCheapestPointWithHalfTheError)
{
    const std::vector<Halving> prices = price_list({{1, 10}, {2, 6}, {4, 5}, {7, 2.5}, {9, 2}});
    ASSERT_EQ(prices.size(), 5U);
    EXPECT_EQ(prices[0].to, 2U);  // exactly half
    EXPECT_EQ(prices[0].extra_ms, 3);
    EXPECT_EQ(prices[0].factor, 2);
    EXPECT_EQ(prices[1].to, 3U);
    EXPECT_DOUBLE_EQ(prices[1].factor, 2.4);
    EXPECT_EQ(prices[2].to, 3U);
    EXPECT_EQ(prices[3].to, std::nullopt);
    EXPECT_EQ(prices[4].to, std::nullopt);
}

std::vector<TimedError> points_on(double floor, double rate)
{
    std::vector<TimedError> points;
    for (const double ms : {1.0, 3.0, 10.0, 40.0})
        points.push_back({ms, floor + rate / ms});
    return points;
}

TEST(Fit, FindsFloorAndRate)
{
    const auto fit = fit_error(points_on(0.02, 0.5));
    ASSERT_TRUE(fit);
    EXPECT_THAT(fit->floor, DoubleNear(0.02, 1e-12));  // ulp of the sums, of size 1e4
    EXPECT_THAT(fit->rate, DoubleNear(0.5, 1e-12));
}

TEST(Fit, NeitherFloorNorRateIsNegative)
{
    // Falls faster than 1 / t; rises.
    const auto steep = fit_error({{1, 1}, {10, 0.01}});
    ASSERT_TRUE(steep);
    EXPECT_EQ(steep->floor, 0);
    EXPECT_GT(steep->rate, 0);
    const auto rising = fit_error({{1, 0.1}, {10, 0.2}});
    ASSERT_TRUE(rising);
    EXPECT_EQ(rising->rate, 0);
    EXPECT_GT(rising->floor, 0.1);
    EXPECT_LT(rising->floor, 0.2);
}

TEST(Fit, AKnownFloorLeavesTheRate)
{
    const auto fit = fit_error(points_on(0.02, 0.5), 0.02);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->floor, 0.02);
    EXPECT_THAT(fit->rate, DoubleNear(0.5, 1e-12));
    EXPECT_EQ(fit_error({{1, 0.1}}, 0.2)->rate, 0);  // all below the floor
}

TEST(Fit, UnbiasedNeedsOnePoint)
{
    const auto fit = fit_error({{4, 0.5}}, 0);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->floor, 0);
    EXPECT_DOUBLE_EQ(fit->rate, 2);
    EXPECT_FALSE(fit_error({{4, 0.5}}));
    EXPECT_FALSE(fit_error({{4, 0.5}, {4, 0.4}}));
    EXPECT_FALSE(fit_error({}, 0));
}

TEST(Fit, SlopeOfPowers)
{
    EXPECT_THAT(*log_slope(points_on(0, 3)), DoubleNear(-1, 1e-12));
    EXPECT_THAT(*log_slope({{1, 2}, {4, 4}, {16, 8}}), DoubleNear(0.5, 1e-12));
    EXPECT_FALSE(log_slope({{1, 1}}));
}

TEST(Fit, CrossingIsWhereBothAreEqual)
{
    const ErrorFit plain{0, 2};
    const ErrorFit filtered{0.01, 0.5};
    const auto at = crossing(plain, filtered);
    ASSERT_TRUE(at);
    EXPECT_DOUBLE_EQ(*at, 150);
    EXPECT_DOUBLE_EQ(plain.rate / *at, filtered.floor + filtered.rate / *at);
    EXPECT_EQ(crossing(plain, {0.01, 3}), 0);  // worse at all times
    EXPECT_FALSE(crossing(plain, {0, 1}));  // no floor: better at all times
}

}  // namespace
}  // namespace farlight
