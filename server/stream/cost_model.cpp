// Regressors, first guess, and the fit.
#include "server/stream/cost_model.h"

#include <algorithm>

namespace farlight {
namespace {

/// What the passes cost that neither samples nor a-trous iterations multiply, in samples and in
/// iterations: README's table of passes, gbuffer over path_trace and (temporal, variance,
/// composite, tonemap) over one a-trous pass.
constexpr double kGBufferSamples = 0.3;
constexpr double kOtherIterations = 1.5;

/// Before two choices have been seen: the share of a frame that no choice makes cheaper (on
/// hardware: launches and barriers of some twenty passes).
constexpr double kFixedShare = 0.1;
/// Share of denoising where only the sum is known: what the table of passes in README shows is
/// more, hardware less.
constexpr double kDenoiseShare = 0.5;
/// Times of equal frames scatter by this on a quiet machine.
constexpr double kScatter = 0.1;
/// Less than this is a timer that did not tick [ms].
constexpr double kLeastMs = 1e-4;

std::array<double, 4> regressors_of(double megapixels, const Choice& choice)
{
    const auto scale = static_cast<double>(choice.resolution_scale);
    const double drawn = megapixels * scale * scale;
    return {1, drawn * (choice.samples_per_pixel + kGBufferSamples), 1,
        drawn * (choice.atrous_iterations + kOtherIterations)};
}

}  // namespace

void CostModel::begin(const Fit::Row& regressors, double trace_ms, double denoise_ms)
{
    const Fit::Row guess{kFixedShare * trace_ms, (1 - kFixedShare) * trace_ms / regressors[1],
        kFixedShare * denoise_ms, (1 - kFixedShare) * denoise_ms / regressors[3]};
    // As large as the guess; what is fixed may be half of all.
    const Fit::Row doubt{trace_ms / 2, guess[1], denoise_ms / 2, guess[3]};
    fit_.emplace(guess, doubt, kMemory);
}

void CostModel::add_frame(
    double megapixels, const Choice& choice, double trace_ms, double denoise_ms)
{
    const Fit::Row row = regressors_of(megapixels, choice);
    const double trace = std::max(trace_ms, kLeastMs);
    const double denoise = std::max(denoise_ms, kLeastMs);
    if (!fit_)
        begin(row, trace, denoise);
    fit_->add({row[0], row[1], 0, 0}, trace, kScatter * trace);
    fit_->add({0, 0, row[2], row[3]}, denoise, kScatter * denoise);
}

void CostModel::add_total(double megapixels, const Choice& choice, double ms)
{
    const Fit::Row row = regressors_of(megapixels, choice);
    const double total = std::max(ms, kLeastMs);
    if (!fit_)
        begin(row, (1 - kDenoiseShare) * total, kDenoiseShare * total);
    fit_->add(row, total, kScatter * total);
}

void CostModel::follow_load(
    double megapixels, const Choice& choice, double trace_ms, double denoise_ms, double weight)
{
    const auto [trace, denoise] = parts_of(regressors_of(megapixels, choice));
    const auto factor = [weight](double found, double expected) {
        return expected > 0 ? 1 + weight * (std::max(found, kLeastMs) / expected - 1) : 1;
    };
    const double of_trace = factor(trace_ms, trace);
    const double of_denoise = factor(denoise_ms, denoise);
    fit_->scale({of_trace, of_trace, of_denoise, of_denoise});
}

void CostModel::scale(double factor)
{
    fit_->scale({factor, factor, factor, factor});
}

/// More work is never cheaper: no coefficient counts as less than 0.
std::pair<double, double> CostModel::parts_of(const Fit::Row& regressors) const
{
    const auto term = [&](std::size_t i) {
        return regressors[i] * std::max(fit_->coefficients()[i], 0.0);
    };
    return {term(0) + term(1), term(2) + term(3)};
}

double CostModel::ms(double megapixels, const Choice& choice) const
{
    if (!fit_)
        return 0;
    const auto [trace, denoise] = parts_of(regressors_of(megapixels, choice));
    return trace + denoise;
}

}  // namespace farlight
