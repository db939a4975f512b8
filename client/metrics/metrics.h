// Error metrics between a picture x and its reference r, value by value: formulas are in
// metric_table.h. Linear RGB before tone mapping, three values a pixel; all sums are in double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace farlight::client {

/// Pictures that must not be compared: different sizes, or non-finite values, which no mean may
/// hide.
struct MetricError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Keeps relMSE finite where the reference is black; source: Rousselle et al. 2011, "Adaptive
/// Sampling and Reconstruction using Greedy Error Minimization".
constexpr double kRelMseEpsilon = 0.01;
/// Share of the pixels that relMSE 99.9 leaves out, rounded down to whole pixels.
constexpr double kWorstShare = 0.001;

/// Which pixels count: one byte a pixel, 0 does not. Empty: all count. What is left out is neither
/// looked at nor divided by, so that a half empty picture has the same error as its full half.
using Mask = std::span<const std::uint8_t>;

struct ImageSize {
    int width = 0;  ///< [px]
    int height = 0;  ///< [px]

    std::size_t pixels() const
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

std::size_t count_nonfinite(std::span<const float> values);

/// Throws MetricError when there is a mask and it has not `pixels` pixels.
void expect_fitting(Mask mask, std::size_t pixels);

/// Throws MetricError when a value that counts is not finite, when sizes differ, when none counts.
void expect_comparable(
    std::span<const float> test, std::span<const float> reference, Mask mask = {});

/// All throw MetricError as expect_comparable() does.
double mean_square_error(
    std::span<const float> test, std::span<const float> reference, Mask mask = {});
double root_mean_square_error(
    std::span<const float> test, std::span<const float> reference, Mask mask = {});
double relative_mse(std::span<const float> test, std::span<const float> reference, Mask mask = {});
/// Without the worst 0.1 % of the pixels; what it lacks against relative_mse() is in fireflies.
double relative_mse_999(
    std::span<const float> test, std::span<const float> reference, Mask mask = {});
/// Symmetric mean absolute percentage error, in [0, 2].
double smape(std::span<const float> test, std::span<const float> reference, Mask mask = {});
/// Pixels with a channel far above the reference.
double count_fireflies(
    std::span<const float> test, std::span<const float> reference, Mask mask = {});
/// Of display values in [0, 1] [dB]; infinite for equal pictures.
double peak_signal_to_noise(
    std::span<const float> test, std::span<const float> reference, Mask mask = {});

/// relMSE of each pixel: the mean over its channels.
std::vector<double> relative_square_errors(
    std::span<const float> test, std::span<const float> reference);

double mean_value(std::span<const float> values);
double largest_value(std::span<const float> values);

/// Rec. 709.
constexpr double luminance(double r, double g, double b)
{
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
std::vector<double> luminances(std::span<const float> rgb);

/// Share of RGB pixels with any channel above 0, in [0, 1].
double share_lit(std::span<const float> values);

}  // namespace farlight::client
