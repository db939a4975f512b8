// Intervals of medians and ratios by resampling, for times that follow no known distribution.
#pragma once

#include <utility>
#include <vector>

namespace farlight::client {

/// Interval that holds the true value in 95 of 100 runs.
struct Interval {
    double lower = 0;
    double upper = 0;
};

/// median(a) / median(b) of times taken in pairs, so that what slows both down at once cancels.
/// Seeded: equal input gives the equal interval. Both of equal length, at least 1.
/// Source: Efron 1979, "Bootstrap Methods: Another Look at the Jackknife" (percentile interval).
struct RatioOfMedians {
    double ratio = 1;
    Interval interval;
};
RatioOfMedians ratio_of_medians(const std::vector<double>& a, const std::vector<double>& b);

/// 0 of no values.
double median(std::vector<double> values);

}  // namespace farlight::client
