// Running sums over frames.
#include "client/metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace farlight::client {
namespace {

constexpr double kHiddenBehind = 0.99;  // of its depth: what is nearer than that is another surface

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

/// The farthest depth of the up to four pixels around (x, y), which are those that a reprojection
/// reads. A surface that was seen there is between them, however steep. Where nothing is, that is
/// beyond all.
double farthest_around(std::span<const float> depth, ImageSize size, double x, double y)
{
    double farthest = 0;
    for (const double row : {std::floor(y), std::ceil(y)})
        for (const double column : {std::floor(x), std::ceil(x)}) {
            const auto i = static_cast<std::size_t>(std::clamp(row, 0.0, size.height - 1.0))
                    * static_cast<std::size_t>(size.width)
                + static_cast<std::size_t>(std::clamp(column, 0.0, size.width - 1.0));
            const double here = static_cast<double>(depth[3 * i]);
            farthest =
                std::max(farthest, here > 0 ? here : std::numeric_limits<double>::infinity());
        }
    return farthest;
}

}  // namespace

void FlickerMeter::add(std::span<const float> frame, std::span<const float> truth)
{
    expect_comparable(frame, truth.empty() ? frame : truth);
    const std::vector<double> level = luminances(frame);
    std::vector<double> now = level;
    if (!truth.empty()) {
        const std::vector<double> expected = luminances(truth);
        std::transform(now.begin(), now.end(), expected.begin(), now.begin(), std::minus<>());
    }
    if (frames_ == 0) {
        mean_.assign(now.size(), 0);
        level_ = squares_ = steps_ = mean_;
        last_ = now;
    }
    if (now.size() != mean_.size())
        throw MetricError("frame " + std::to_string(frames_) + " has " + std::to_string(now.size())
            + " pixels, the first " + std::to_string(mean_.size()));
    ++frames_;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const double away = now[i] - mean_[i];
        mean_[i] += away / frames_;
        level_[i] += (level[i] - level_[i]) / frames_;
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
    expect_fitting(mask, mean_.size());
}

double FlickerMeter::flicker(Mask mask) const
{
    expect_pairs(mask);
    return mean_over_pixels(mean_.size(), mask,
        [&](std::size_t i) { return std::sqrt(squares_[i] / (frames_ - 1)) / (level_[i] + 0.01); });
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
    const auto first = std::find_if(errors.begin(), errors.end(),
        [&](double error) { return error < 2 * settled || error <= settled; });
    return static_cast<int>(first - errors.begin());
}

double residual(std::span<const double> errors, std::size_t frames_after)
{
    if (frames_after >= errors.size())
        throw MetricError("residual: found " + std::to_string(errors.size())
            + " frames from the step on, expected more than " + std::to_string(frames_after));
    return errors[frames_after] / errors.front();
}

std::vector<std::uint8_t> newly_revealed(std::span<const float> depth,
    std::span<const float> motion, std::span<const float> depth_before, ImageSize size)
{
    for (const auto view : {depth, motion, depth_before}) {
        expect_comparable(view, view);
        expect_comparable(view, depth);
    }
    if (depth.size() != 3 * size.pixels())
        throw MetricError("ghost: found " + std::to_string(depth.size()) + " values, expected "
            + std::to_string(3 * size.pixels()));
    std::vector<std::uint8_t> revealed(size.pixels(), 0);
    const auto width = static_cast<std::size_t>(size.width);
    for (std::size_t i = 0; i < revealed.size(); ++i) {
        if (!(depth[3 * i] > 0))
            continue;
        const std::size_t row = i / width;
        const double x = static_cast<double>(i % width) + static_cast<double>(motion[3 * i]);
        const double y = static_cast<double>(row) + static_cast<double>(motion[3 * i + 1]);
        const bool inside = x > -0.5 && x < size.width - 0.5 && y > -0.5 && y < size.height - 0.5;
        if (!inside)
            continue;
        const double expected =
            static_cast<double>(depth[3 * i]) + static_cast<double>(motion[3 * i + 2]);
        revealed[i] = farthest_around(depth_before, size, x, y) < kHiddenBehind * expected ? 1 : 0;
    }
    return revealed;
}

double ghost_residue(std::span<const float> test, std::span<const float> reference, Mask revealed)
{
    if (std::count(revealed.begin(), revealed.end(), 0) == std::ssize(revealed))
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
