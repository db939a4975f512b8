// Bias and variance apart, from independent runs of one picture with different seeds.
#pragma once

#include "client/metrics/bootstrap.h"
#include "client/metrics/metrics.h"

namespace farlight::client {

/// Mean over pixels and channels, relative to r^2 + 0.01 as relMSE is, so that
/// relmse = bias + variance. `bias` is squared, and unbiased itself: noise may take it below 0.
struct ErrorSplit {
    Estimate relmse;  ///< Of one run, averaged over the runs.
    Estimate bias;  ///< What no number of runs averages away.
    Estimate variance;  ///< What averaging runs removes.
};

/// Keeps the products of all pairs of runs; the pictures themselves are the caller's.
class Ensemble {
public:
    /// `reference_variance`: the variance of the reference's own values, which would count as bias;
    /// empty: none. Throws MetricError as expect_comparable() does.
    Ensemble(const std::vector<std::span<const float>>& runs, std::span<const float> reference,
        std::span<const float> reference_variance = {}, Mask mask = {});

    /// Without intervals, of 2 runs or more, else MetricError.
    double bias() const;
    double variance() const;
    /// Seeded bootstrap over the runs, at least 3 of them, else MetricError.
    ErrorSplit split() const;
    /// Error of the mean of all runs, sqrt of which decreases as 1 / sqrt(runs) down to the bias.
    double relmse_of_mean() const;

private:
    std::size_t runs_;
    /// Row by row: mean of (x_k - r) (x_l - r) / (r^2 + 0.01).
    std::vector<double> products_;
    double reference_noise_ = 0;  ///< In every product alike.
};

/// Mean of each value over the runs, all of one size.
std::vector<float> mean_picture(const std::vector<std::span<const float>>& runs);
/// Variance of each value over the runs, at least 2, divided by one less than their number.
std::vector<float> variance_picture(const std::vector<std::span<const float>>& runs);

}  // namespace farlight::client
