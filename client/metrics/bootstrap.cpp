// Percentile and studentised bootstrap.
#include "client/metrics/bootstrap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace farlight::client {
namespace {

constexpr int kResamples = 2000;  // the interval's ends then vary by about 1 % of its width
constexpr int kStudentResamples = 1000;  // each with a jackknife inside
constexpr double kOutside = 0.025;  // on either side
constexpr std::size_t kTooFewToDraw = 3;  // they make ten different draws
constexpr double kStudentOfThree = 4.3027;  // Student's t, two degrees of freedom, at 0.975
constexpr double kRounding = 1e-12;  // of sums of up to thousands of doubles, relative

double sorted_at(const std::vector<double>& sorted, double share)
{
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

Interval middle_of(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return {sorted_at(values, kOutside), sorted_at(values, 1 - kOutside)};
}

/// Leaves out one run at a time.
double jackknife_error(std::span<const std::size_t> runs, const StatisticOfRuns& statistic)
{
    const std::size_t n = runs.size();
    std::vector<std::size_t> others(runs.begin() + 1, runs.end());
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
        values.push_back(statistic(others));
        if (i + 1 < n)
            others[i] = runs[i];
    }
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(n);
    double squares = 0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    return std::sqrt(squares * static_cast<double>(n - 1) / static_cast<double>(n));
}

}  // namespace

double median(std::vector<double> values)
{
    if (values.empty())
        return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1)
        return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

RatioOfMedians ratio_of_medians(const std::vector<double>& a, const std::vector<double>& b)
{
    assert(a.size() == b.size() && !a.empty());
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> pick(0, a.size() - 1);
    std::vector<double> ratios;
    std::vector<double> some_a(a.size());
    std::vector<double> some_b(a.size());
    for (int i = 0; i < kResamples; ++i) {
        for (std::size_t k = 0; k < a.size(); ++k) {
            const std::size_t pair = pick(random);
            some_a[k] = a[pair];
            some_b[k] = b[pair];
        }
        ratios.push_back(median(some_a) / median(some_b));
    }
    return {median(a) / median(b), middle_of(std::move(ratios))};
}

Estimate estimate_mean(const std::vector<double>& values)
{
    assert(!values.empty());
    const auto mean = [&](std::span<const std::size_t> runs) {
        double sum = 0;
        for (const std::size_t run : runs)
            sum += values[run];
        return sum / static_cast<double>(runs.size());
    };
    if (values.size() >= 3)
        return estimate_by_runs(values.size(), mean);
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    const double value =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    return {value, {-kEndless, kEndless}};
}

Estimate estimate_by_runs(std::size_t runs, const StatisticOfRuns& statistic)
{
    assert(runs >= 3);
    std::vector<std::size_t> all(runs);
    std::iota(all.begin(), all.end(), std::size_t{0});
    const double value = statistic(all);
    const double error = jackknife_error(all, statistic);
    if (runs == kTooFewToDraw)
        return {value, {value - kStudentOfThree * error, value + kStudentOfThree * error}};
    std::mt19937 random(1);
    std::uniform_int_distribution<std::size_t> pick(0, runs - 1);
    std::vector<double> deviations;
    std::vector<std::size_t> some(runs);
    for (int i = 0; i < kStudentResamples; ++i) {
        std::generate(some.begin(), some.end(), [&] { return pick(random); });
        const double some_error = jackknife_error(some, statistic);
        const double some_value = statistic(some);
        // Of one run drawn again and again there is no error but what rounding leaves.
        if (some_error > kRounding * std::abs(some_value) && std::isfinite(some_value))
            deviations.push_back((some_value - value) / some_error);
    }
    if (deviations.empty())
        return {value, {value, value}};  // all runs are equal
    const Interval t = middle_of(std::move(deviations));
    return {value, {value - t.upper * error, value - t.lower * error}};
}

}  // namespace farlight::client
