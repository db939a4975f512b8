// Means of estimates, and what follows from them for other choices.
#include "server/stream/rung_errors.h"

#include <algorithm>
#include <cmath>

namespace farlight {
namespace {

/// Weight of a new frame: five frames count, as an estimate from one frame scatters by a tenth and
/// the view moves on within a second.
constexpr double kNewWeight = 0.2;

/// Some of an error is always noise, so that more samples are always worth something.
constexpr double kLeastNoise = 0.05;

void blend(double& mean, double value)
{
    mean = std::isfinite(mean) ? mean + kNewWeight * (value - mean) : value;
}

/// What samples and filter are to noise.
double averaged_by(const Choice& choice)
{
    return choice.samples_per_pixel * std::exp2(choice.atrous_iterations);
}

/// An error beyond those that are known, from the nearest of them.
double extrapolate(const Choice& choice, const Choice& known, const RungError& error)
{
    const auto pixels = [](const Choice& of) {
        return static_cast<double>(of.resolution_scale) * static_cast<double>(of.resolution_scale);
    };
    const double noise = error.noise * (averaged_by(known) / averaged_by(choice));
    return (error.value - error.noise + noise) * (pixels(known) / pixels(choice));
}

/// A value between those of two known choices, linear in the logarithms.
double interpolate(double strength, const Choice& a, double at_a, const Choice& b, double at_b)
{
    const double t =
        std::log(strength / strength_of(a)) / std::log(strength_of(b) / strength_of(a));
    return at_a * std::pow(at_b / at_a, t);
}

}  // namespace

void RungErrors::add(const Choice& choice, RungError estimate)
{
    ++frames_;
    if (!(estimate.value > 0 && std::isfinite(estimate.value)))
        return;
    if (!std::isfinite(estimate.noise))
        estimate.noise = estimate.value;
    estimate.noise = std::clamp(estimate.noise, kLeastNoise * estimate.value, estimate.value);
    if (choice.resolution_scale < 1) {
        const auto scale = static_cast<double>(choice.resolution_scale);
        estimate = {
            .value = estimate.value / (scale * scale), .noise = estimate.noise / (scale * scale)};
    }
    const auto same = std::find_if(
        known_.begin(), known_.end(), [&](const Known& one) { return one.choice == choice; });
    if (same == known_.end()) {
        known_.push_back({choice, estimate, frames_});
        return;
    }
    if (frames_ - same->frame > kMemory) {
        same->error = estimate;
    } else {
        blend(same->error.value, estimate.value);
        blend(same->error.lower, estimate.lower);
        blend(same->error.upper, estimate.upper);
        blend(same->error.noise, estimate.noise);
    }
    same->frame = frames_;
}

/// Those that are young enough and fall with strength, in the order of strength.
std::vector<RungErrors::Known> RungErrors::consistent() const
{
    std::vector<Known> newest_first = known_;
    std::sort(newest_first.begin(), newest_first.end(),
        [](const Known& a, const Known& b) { return a.frame > b.frame; });
    std::vector<Known> kept;
    for (const Known& one : newest_first) {
        const auto agrees = [&](const Known& other) {
            const double strength = strength_of(one.choice);
            const double other_strength = strength_of(other.choice);
            return strength > other_strength
                ? one.error.value < other.error.value
                : strength < other_strength && one.error.value > other.error.value;
        };
        if (frames_ - one.frame <= kMemory && std::all_of(kept.begin(), kept.end(), agrees))
            kept.push_back(one);
    }
    std::sort(kept.begin(), kept.end(), [](const Known& a, const Known& b) {
        return strength_of(a.choice) < strength_of(b.choice);
    });
    return kept;
}

std::vector<std::optional<RungError>> RungErrors::errors_of(
    const std::vector<Choice>& choices) const
{
    const std::vector<Known> known = consistent();
    std::vector<std::optional<RungError>> errors(choices.size());
    for (std::size_t i = 0; i < choices.size() && !known.empty(); ++i) {
        const double strength = strength_of(choices[i]);
        const auto above = std::lower_bound(known.begin(), known.end(), strength,
            [](const Known& one, double s) { return strength_of(one.choice) < s; });
        if (above != known.end() && above->choice == choices[i])
            errors[i] = above->error;
        else if (above == known.begin())
            errors[i] = {extrapolate(choices[i], above->choice, above->error)};
        else if (const auto below = above - 1; above == known.end())
            errors[i] = {extrapolate(choices[i], below->choice, below->error)};
        else
            errors[i] = {interpolate(
                strength, below->choice, below->error.value, above->choice, above->error.value)};
    }
    return errors;
}

}  // namespace farlight
