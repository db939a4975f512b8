// Error metrics between a picture and its reference, on linear RGB before tone mapping. All sums
// are in double.
//
//   relMSE = mean over pixels and channels of (x - r)^2 / (r^2 + 0.01)
//   RMSE   = square root of the mean of (x - r)^2
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

namespace farlight::client {

/// Pictures that must not be compared: different sizes, or non-finite values, which no mean may
/// hide.
struct MetricError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Keeps relMSE finite where the reference is black; source: Rousselle et al. 2011, "Adaptive
/// Sampling and Reconstruction using Greedy Error Minimization".
constexpr double kRelMseEpsilon = 0.01;
constexpr const char* kRelMseFormula = "mean((x - r)^2 / (r^2 + 0.01))";

std::size_t count_nonfinite(std::span<const float> values);

/// These throw MetricError when a value is not finite, or when sizes differ or are 0.
double relative_mse(std::span<const float> test, std::span<const float> reference);
double root_mean_square_error(std::span<const float> test, std::span<const float> reference);
double mean_value(std::span<const float> values);
double largest_value(std::span<const float> values);

/// Share of RGB pixels with any channel above 0, in [0, 1].
double share_lit(std::span<const float> values);

}  // namespace farlight::client
