// Sums over the values that count.
#include "client/metrics/metrics.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {
namespace {

constexpr std::size_t kRgb = 3;

std::size_t nonfinite_that_count(std::span<const float> values, Mask mask)
{
    if (mask.empty())
        return count_nonfinite(values);
    std::size_t count = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        count += mask[i / kRgb] != 0 && !std::isfinite(values[i]) ? 1 : 0;
    return count;
}

void expect_finite(std::span<const float> values, const char* what, Mask mask = {})
{
    if (values.empty())
        throw MetricError(std::string("the ") + what + " is empty");
    if (const std::size_t bad = nonfinite_that_count(values, mask))
        throw MetricError(std::to_string(bad) + " of " + std::to_string(values.size())
            + " values of the " + what + " are not finite");
}

/// Mean of term(x, r) over the values that count.
template <typename Term>
double mean_of(
    std::span<const float> test, std::span<const float> reference, Mask mask, Term&& term)
{
    expect_comparable(test, reference, mask);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < test.size(); ++i) {
        if (!mask.empty() && mask[i / kRgb] == 0)
            continue;
        sum += term(static_cast<double>(test[i]), static_cast<double>(reference[i]));
        ++count;
    }
    return sum / static_cast<double>(count);
}

double square_error(double x, double r)
{
    return (x - r) * (x - r);
}

double relative_square_error(double x, double r)
{
    return square_error(x, r) / (r * r + kRelMseEpsilon);
}

}  // namespace

std::size_t count_nonfinite(std::span<const float> values)
{
    return static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }));
}

void expect_fitting(Mask mask, std::size_t pixels)
{
    if (!mask.empty() && mask.size() != pixels)
        throw MetricError("the mask has " + std::to_string(mask.size()) + " pixels, the picture "
            + std::to_string(pixels));
}

void expect_comparable(std::span<const float> test, std::span<const float> reference, Mask mask)
{
    if (test.size() != reference.size())
        throw MetricError("the picture has " + std::to_string(test.size())
            + " values, the reference " + std::to_string(reference.size()));
    expect_fitting(mask, test.size() / kRgb);
    expect_finite(test, "picture", mask);
    expect_finite(reference, "reference", mask);
    if (!mask.empty() && std::count(mask.begin(), mask.end(), 0) == std::ssize(mask))
        throw MetricError("the mask leaves no pixel to compare");
}

double mean_square_error(std::span<const float> test, std::span<const float> reference, Mask mask)
{
    return mean_of(test, reference, mask, square_error);
}

double root_mean_square_error(
    std::span<const float> test, std::span<const float> reference, Mask mask)
{
    return std::sqrt(mean_square_error(test, reference, mask));
}

double relative_mse(std::span<const float> test, std::span<const float> reference, Mask mask)
{
    return mean_of(test, reference, mask, relative_square_error);
}

double relative_mse_999(std::span<const float> test, std::span<const float> reference, Mask mask)
{
    expect_comparable(test, reference, mask);
    std::vector<double> errors = relative_square_errors(test, reference);
    if (!mask.empty()) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < errors.size(); ++i)
            if (mask[i] != 0)
                errors[kept++] = errors[i];
        errors.resize(kept);
    }
    const auto left_out =
        static_cast<std::ptrdiff_t>(kWorstShare * static_cast<double>(errors.size()));
    const auto end = errors.end() - left_out;
    if (left_out > 0)
        std::nth_element(errors.begin(), end - 1, errors.end());
    double sum = 0;
    for (auto error = errors.begin(); error != end; ++error)
        sum += *error;
    return sum / static_cast<double>(end - errors.begin());
}

double smape(std::span<const float> test, std::span<const float> reference, Mask mask)
{
    return mean_of(test, reference, mask, [](double x, double r) {
        return 2 * std::abs(x - r) / (std::abs(x) + std::abs(r) + 0.01);
    });
}

double count_fireflies(std::span<const float> test, std::span<const float> reference, Mask mask)
{
    expect_comparable(test, reference, mask);
    std::size_t count = 0;
    for (std::size_t pixel = 0; pixel * kRgb < test.size(); ++pixel) {
        bool far_above = false;
        for (std::size_t i = pixel * kRgb; i < (pixel + 1) * kRgb && i < test.size(); ++i)
            far_above = far_above
                || static_cast<double>(test[i]) > 10 * (static_cast<double>(reference[i]) + 0.1);
        count += far_above && (mask.empty() || mask[pixel] != 0) ? 1 : 0;
    }
    return static_cast<double>(count);
}

double peak_signal_to_noise(
    std::span<const float> test, std::span<const float> reference, Mask mask)
{
    return -10 * std::log10(mean_square_error(test, reference, mask));
}

std::vector<double> relative_square_errors(
    std::span<const float> test, std::span<const float> reference)
{
    if (test.size() != reference.size())
        throw MetricError("the picture has " + std::to_string(test.size())
            + " values, the reference " + std::to_string(reference.size()));
    std::vector<double> errors(test.size() / kRgb);
    for (std::size_t i = 0; i < errors.size() * kRgb; ++i)
        errors[i / kRgb] +=
            relative_square_error(static_cast<double>(test[i]), static_cast<double>(reference[i]))
            / kRgb;
    return errors;
}

double mean_value(std::span<const float> values)
{
    return mean_of(values, values, {}, [](double x, double) { return x; });
}

double largest_value(std::span<const float> values)
{
    expect_finite(values, "picture");
    return *std::max_element(values.begin(), values.end());
}

std::vector<double> luminances(std::span<const float> rgb)
{
    std::vector<double> result(rgb.size() / kRgb);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = luminance(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
    return result;
}

double share_lit(std::span<const float> values)
{
    const std::size_t pixels = values.size() / kRgb;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < pixels; ++i)
        lit += values[3 * i] > 0 || values[3 * i + 1] > 0 || values[3 * i + 2] > 0 ? 1 : 0;
    return pixels == 0 ? 0 : static_cast<double>(lit) / static_cast<double>(pixels);
}

}  // namespace farlight::client
