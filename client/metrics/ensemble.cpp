// Every statistic here is a mean over pairs of runs: over a run with itself it is relMSE, over two
// different ones it is bias alone, because their noise is independent. The difference is variance.
#include "client/metrics/ensemble.h"

#include <limits>
#include <numeric>

namespace farlight::client {
namespace {

constexpr std::size_t kLeastRuns = 3;

struct PairMeans {
    double same = 0;
    double different = 0;
};

/// Pairs of places in `runs`; two places that name one run are no pair of different ones.
PairMeans pair_means(
    std::span<const std::size_t> runs, const std::vector<double>& products, std::size_t count)
{
    PairMeans sums;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const double* row = products.data() + runs[i] * count;
        sums.same += row[runs[i]];
        for (std::size_t j = 0; j < i; ++j)
            if (runs[i] != runs[j]) {
                sums.different += row[runs[j]];
                ++pairs;
            }
    }
    // Without pairs there is no estimate; the bootstrap leaves such a draw out.
    return {sums.same / static_cast<double>(runs.size()),
        pairs > 0 ? sums.different / static_cast<double>(pairs)
                  : std::numeric_limits<double>::quiet_NaN()};
}

std::vector<std::size_t> all_runs(std::size_t count)
{
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

void expect_runs(std::size_t found, std::size_t expected)
{
    if (found < expected)
        throw MetricError("found " + std::to_string(found) + " runs, expected at least "
            + std::to_string(expected));
}

void expect_one_size(const std::vector<std::span<const float>>& runs)
{
    for (const auto run : runs)
        expect_comparable(run, runs.front());
}

}  // namespace

Ensemble::Ensemble(const std::vector<std::span<const float>>& runs,
    std::span<const float> reference, std::span<const float> reference_variance, Mask mask)
    : runs_(runs.size())
    , products_(runs.size() * runs.size())
{
    expect_runs(runs_, 1);
    for (const auto run : runs)
        expect_comparable(run, reference, mask);
    if (!reference_variance.empty())
        expect_comparable(reference_variance, reference, mask);
    std::vector<double> away(runs_);
    std::size_t count = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        if (!mask.empty() && mask[i / 3] == 0)
            continue;
        ++count;
        const double r = static_cast<double>(reference[i]);
        const double weight = 1 / (r * r + kRelMseEpsilon);
        for (std::size_t k = 0; k < runs_; ++k) {
            away[k] = static_cast<double>(runs[k][i]) - r;
            for (std::size_t l = 0; l <= k; ++l)
                products_[k * runs_ + l] += weight * away[k] * away[l];
        }
        if (!reference_variance.empty())
            reference_noise_ += weight * static_cast<double>(reference_variance[i]);
    }
    reference_noise_ /= static_cast<double>(count);
    for (std::size_t k = 0; k < runs_; ++k)
        for (std::size_t l = 0; l <= k; ++l) {
            products_[k * runs_ + l] /= static_cast<double>(count);
            products_[l * runs_ + k] = products_[k * runs_ + l];
        }
}

ErrorSplit Ensemble::split() const
{
    expect_runs(runs_, kLeastRuns);
    const auto estimate = [&](const auto& of) {
        return estimate_by_runs(runs_, [&](std::span<const std::size_t> runs) {
            return of(pair_means(runs, products_, runs_));
        });
    };
    const double noise = reference_noise_;
    return {.relmse = estimate([&](const PairMeans& m) { return m.same - noise; }),
        .bias = estimate([&](const PairMeans& m) { return m.different - noise; }),
        .variance = estimate([](const PairMeans& m) { return m.same - m.different; })};
}

double Ensemble::bias() const
{
    expect_runs(runs_, 2);
    return pair_means(all_runs(runs_), products_, runs_).different - reference_noise_;
}

double Ensemble::variance() const
{
    expect_runs(runs_, 2);
    const PairMeans means = pair_means(all_runs(runs_), products_, runs_);
    return means.same - means.different;
}

double Ensemble::relmse_of_mean() const
{
    double sum = 0;
    for (const double product : products_)
        sum += product;
    return sum / static_cast<double>(products_.size()) - reference_noise_;
}

std::vector<float> mean_picture(const std::vector<std::span<const float>>& runs)
{
    expect_runs(runs.size(), 1);
    expect_one_size(runs);
    std::vector<float> result(runs.front().size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        double sum = 0;
        for (const auto run : runs)
            sum += static_cast<double>(run[i]);
        result[i] = static_cast<float>(sum / static_cast<double>(runs.size()));
    }
    return result;
}

std::vector<float> variance_picture(const std::vector<std::span<const float>>& runs)
{
    expect_runs(runs.size(), 2);
    expect_one_size(runs);
    std::vector<float> result(runs.front().size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        double mean = 0;
        for (const auto run : runs)
            mean += static_cast<double>(run[i]) / static_cast<double>(runs.size());
        double squares = 0;
        for (const auto run : runs) {
            const double away = static_cast<double>(run[i]) - mean;
            squares += away * away;
        }
        result[i] = static_cast<float>(squares / static_cast<double>(runs.size() - 1));
    }
    return result;
}

}  // namespace farlight::client
