// Error metrics: see the formulas in the header.
#include "client/metrics/metrics.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {
namespace {

void expect_finite(std::span<const float> values, const char* what)
{
    if (values.empty())
        throw MetricError(std::string("the ") + what + " is empty");
    if (const std::size_t bad = count_nonfinite(values))
        throw MetricError(std::to_string(bad) + " of " + std::to_string(values.size())
            + " values of the " + what + " are not finite");
}

template <typename Term>
double mean_of(std::span<const float> test, std::span<const float> reference, Term&& term)
{
    expect_finite(test, "picture");
    expect_finite(reference, "reference");
    if (test.size() != reference.size())
        throw MetricError("the picture has " + std::to_string(test.size())
            + " values, the reference " + std::to_string(reference.size()));
    double sum = 0;
    for (std::size_t i = 0; i < test.size(); ++i)
        sum += term(static_cast<double>(test[i]), static_cast<double>(reference[i]));
    return sum / static_cast<double>(test.size());
}

}  // namespace

std::size_t count_nonfinite(std::span<const float> values)
{
    return static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](float v) { return !std::isfinite(v); }));
}

double relative_mse(std::span<const float> test, std::span<const float> reference)
{
    return mean_of(test, reference,
        [](double x, double r) { return (x - r) * (x - r) / (r * r + kRelMseEpsilon); });
}

double root_mean_square_error(std::span<const float> test, std::span<const float> reference)
{
    return std::sqrt(
        mean_of(test, reference, [](double x, double r) { return (x - r) * (x - r); }));
}

double mean_value(std::span<const float> values)
{
    return mean_of(values, values, [](double x, double) { return x; });
}

double largest_value(std::span<const float> values)
{
    expect_finite(values, "picture");
    return *std::max_element(values.begin(), values.end());
}

double share_lit(std::span<const float> values)
{
    const std::size_t pixels = values.size() / 3;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < pixels; ++i)
        lit += values[3 * i] > 0 || values[3 * i + 1] > 0 || values[3 * i + 2] > 0 ? 1 : 0;
    return pixels == 0 ? 0 : static_cast<double>(lit) / static_cast<double>(pixels);
}

}  // namespace farlight::client
