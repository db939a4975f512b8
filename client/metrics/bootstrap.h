// Intervals by resampling, for what follows no known distribution.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace farlight::client {

/// Interval that holds the true value in 95 of 100 runs.
struct Interval {
    double lower = 0;
    double upper = 0;
};

struct Estimate {
    double value = 0;
    Interval interval;
};

/// median(a) / median(b) of times taken in pairs, so that what slows both down at once cancels.
/// Seeded: equal input gives the equal interval. Both of equal length, at least 1.
/// Source: Efron 1979, "Bootstrap Methods: Another Look at the Jackknife" (percentile interval).
struct RatioOfMedians {
    double ratio = 1;
    Interval interval;
};
RatioOfMedians ratio_of_medians(const std::vector<double>& a, const std::vector<double>& b);

/// The mean and its interval; one value has an endless one. See estimate_by_runs().
Estimate estimate_mean(const std::vector<double>& values);

/// A statistic of runs, named by their indices; the same run may be named more than once.
using StatisticOfRuns = std::function<double(std::span<const std::size_t> runs)>;
/// Studentised bootstrap over few (at least 3) independent runs, with the jackknife's standard
/// error inside and out: the percentile interval of ten runs holds the truth in 90 of 100 cases
/// only. Three runs, of which too few different draws can be made, have Student's t instead.
/// Seeded. Source: Efron, Tibshirani 1993, "An Introduction to the Bootstrap",
/// sections 11.5, 12.5.
Estimate estimate_by_runs(std::size_t runs, const StatisticOfRuns& statistic);

/// 0 of no values.
double median(std::vector<double> values);

}  // namespace farlight::client
