// Means, errors and picture metrics for tests.
#pragma once

#include "server/render/image.h"

#include <glm/glm.hpp>
#include <vector>

namespace farlight {

struct Estimate {
    double mean = 0;
    double standard_error = 0;
};

/// Mean over all pixels and channels of a linear image, and its standard error taking pixels as
/// independent.
Estimate mean_of(const Image& image);

/// a - b, value by value: for means whose error is not to contain what both pictures show.
Image difference_of(const Image& a, Image b);

/// Mean over pixels and channels of (x - r)^2 / (r^2 + 0.01).
double relative_mse(const Image& image, const Image& reference);

/// Probability of a chi-squared statistic this large or larger. Bins are pooled until each expects
/// 5; of what no bin is expected to hold, 10 are put down to rounding.
double chi_squared_p_value(const std::vector<double>& expected, const std::vector<double>& found);

}  // namespace farlight
