// Running sums over frames.
#include "client/metrics/temporal.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {
namespace {

template <typename Of> double mean_over_pixels(std::size_t pixels, Mask mask, Of&& of)
{
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!mask.empty() && mask[i] == 0)
            continue;
        sum += of(i);
        ++count;
    }
    if (count == 0)
        throw MetricError("the mask leaves no pixel to compare");
    return sum / static_cast<double>(count);
}

}  // namespace

void FlickerMeter::add(std::span<const float> frame)
{
    expect_comparable(frame, frame);
    const std::vector<double> now = luminances(frame);
    if (frames_ == 0) {
        mean_.assign(now.size(), 0);
        squares_ = steps_ = mean_;
        last_ = now;
    }
    if (now.size() != mean_.size())
        throw MetricError("frame " + std::to_string(frames_) + " has " + std::to_string(now.size())
            + " pixels, the first " + std::to_string(mean_.size()));
    ++frames_;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double away = now[i] - mean_[i];
        mean_[i] += away / frames_;
        squares_[i] += away * (now[i] - mean_[i]);
        steps_[i] += std::abs(now[i] - last_[i]);
    }
    last_ = now;
}

void FlickerMeter::expect_pairs(Mask mask) const
{
    if (frames_ < 2)
        throw MetricError(
            "flicker: found " + std::to_string(frames_) + " frames, expected at least 2");
    if (!mask.empty() && mask.size() != mean_.size())
        throw MetricError("the mask has " + std::to_string(mask.size()) + " pixels, the frames "
            + std::to_string(mean_.size()));
}

double FlickerMeter::flicker(Mask mask) const
{
    expect_pairs(mask);
    return mean_over_pixels(mean_.size(), mask,
        [&](std::size_t i) { return std::sqrt(squares_[i] / (frames_ - 1)) / (mean_[i] + 0.01); });
}

double FlickerMeter::successive_difference(Mask mask) const
{
    expect_pairs(mask);
    return mean_over_pixels(
        mean_.size(), mask, [&](std::size_t i) { return steps_[i] / (frames_ - 1); });
}

int lag_frames(std::span<const double> errors)
{
    if (errors.empty())
        throw MetricError("lag: found no frame after the step");
    const double settled = errors.back();
    const auto first = std::find_if(
        errors.begin(), errors.end(), [&](double error) { return error < 2 * settled; });
    return static_cast<int>(first - errors.begin());
}

double residual(std::span<const double> errors, std::size_t frames_after)
{
    if (frames_after >= errors.size())
        throw MetricError("residual: found " + std::to_string(errors.size())
            + " frames from the step on, expected more than " + std::to_string(frames_after));
    return errors[frames_after] / errors.front();
}

double ghost_residue(std::span<const float> test, std::span<const float> reference, Mask revealed)
{
    if (revealed.empty())
        throw MetricError("ghost: no pixel is newly revealed");
    expect_comparable(test, reference, revealed);
    double largest = 0;
    for (std::size_t i = 0; i < test.size(); ++i) {
        const double x = static_cast<double>(test[i]);
        const double r = static_cast<double>(reference[i]);
        if (revealed[i / 3] != 0)
            largest = std::max(largest, std::abs(x - r) / (r + 0.01));
    }
    return largest;
}

}  // namespace farlight::client
