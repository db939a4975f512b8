// RecursiveFit: linear least squares, one observation at a time, older ones forgotten.
// Source: Ljung 1999, "System Identification: Theory for the User", section 11.2 (recursive least
// squares with a forgetting factor).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace farlight {

template <std::size_t N> class RecursiveFit {
public:
    using Row = std::array<double, N>;

    /// `guess`: the coefficients before any observation; `doubt`: standard deviations of them.
    /// `memory`: an observation counts half as much as one that is `memory` younger.
    RecursiveFit(const Row& guess, const Row& doubt, double memory)
        : coefficients_(guess)
        , doubt_(doubt)
        , forgetting_(std::exp2(-1 / memory))
    {
        for (std::size_t i = 0; i < N; ++i)
            covariance_[i][i] = doubt[i] * doubt[i];
    }

    const Row& coefficients() const { return coefficients_; }

    /// `value` was observed where the regressors were `row`, with this standard deviation.
    void add(const Row& row, double value, double deviation)
    {
        const Row gain_above = times(row);
        const double below = forgetting_ * deviation * deviation + inner(row, gain_above);
        const double surprise = value - inner(row, coefficients_);
        for (std::size_t i = 0; i < N; ++i)
            coefficients_[i] += gain_above[i] / below * surprise;
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t j = 0; j < N; ++j)
                covariance_[i][j] =
                    (covariance_[i][j] - gain_above[i] * gain_above[j] / below) / forgetting_;
        bound();
    }

    /// Everything observed so far would be other by these factors, one a coefficient.
    void scale(const Row& factors)
    {
        for (std::size_t i = 0; i < N; ++i) {
            coefficients_[i] *= factors[i];
            doubt_[i] *= factors[i];
            for (std::size_t j = 0; j < N; ++j)
                covariance_[i][j] *= factors[i] * factors[j];
        }
    }

private:
    static double inner(const Row& a, const Row& b)
    {
        double sum = 0;
        for (std::size_t i = 0; i < N; ++i)
            sum += a[i] * b[i];
        return sum;
    }

    Row times(const Row& row) const
    {
        Row product{};
        for (std::size_t i = 0; i < N; ++i)
            product[i] = inner(covariance_[i], row);
        return product;
    }

    /// No coefficient is ever doubted more than at the start. Without this, forgetting lets doubt
    /// grow for ever in directions that equal observations say nothing about ("estimator windup").
    void bound()
    {
        for (std::size_t i = 0; i < N; ++i) {
            const double most = doubt_[i] * doubt_[i];
            if (covariance_[i][i] <= most)
                continue;
            const double scale = std::sqrt(most / covariance_[i][i]);
            for (std::size_t j = 0; j < N; ++j) {
                covariance_[i][j] *= scale;
                covariance_[j][i] *= scale;
            }
        }
    }

    Row coefficients_{};
    Row doubt_{};
    std::array<Row, N> covariance_{};
    double forgetting_;
};

}  // namespace farlight
