// FLIP from filtered colours and features, its exposures, and pooling.
#include "client/metrics/flip.h"

#include "client/metrics/display.h"
#include "client/metrics/flip_color.h"
#include "client/metrics/flip_filters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace farlight::client {
namespace {

constexpr double kFeatureExponent = 0.5;  // q_f
constexpr double kWhiteLevel = 0.85;  // t: the level of the tone curve that exposures are set by

Planes opponent_of(const std::vector<Color>& linear)
{
    Planes planes{Plane(linear.size()), Plane(linear.size()), Plane(linear.size())};
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const Color c = ycxcz_of_linear(linear[i]);
        planes.x[i] = c.x;
        planes.y[i] = c.y;
        planes.z[i] = c.z;
    }
    return planes;
}

/// LDR-FLIP of linear colours in [0, 1].
std::vector<float> flip_of_screens(const std::vector<Color>& test,
    const std::vector<Color>& reference, ImageSize size, double pixels_per_degree)
{
    const Planes test_opponent = opponent_of(test);
    const Planes reference_opponent = opponent_of(reference);
    const Features test_features = features_of(test_opponent, size, pixels_per_degree);
    const Features reference_features = features_of(reference_opponent, size, pixels_per_degree);
    const Planes x = seen(test_opponent, size, pixels_per_degree);
    const Planes r = seen(reference_opponent, size, pixels_per_degree);
    std::vector<float> errors(test.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double color = color_difference(
            screen_of_ycxcz({x.x[i], x.y[i], x.z[i]}), screen_of_ycxcz({r.x[i], r.y[i], r.z[i]}));
        const double feature =
            std::max(std::abs(test_features.edges[i] - reference_features.edges[i]),
                std::abs(test_features.points[i] - reference_features.points[i]));
        const double weight = std::pow(feature / std::numbers::sqrt2, kFeatureExponent);
        errors[i] = static_cast<float>(std::pow(color, 1 - weight));
    }
    return errors;
}

/// Numerator and denominator of the ACES curve by powers of x, 2 first, with the factor 0.6 that
/// its author gives for pictures not exposed for it.
constexpr std::array<double, 3> kCurveOver{0.6 * 0.6 * 2.51, 0.6 * 0.03, 0};
constexpr std::array<double, 3> kCurveUnder{0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

double tone(double x)
{
    constexpr double kFarWhite = 1e6;  // the curve is above 1 from 8 on, and 1e6^2 is no problem
    const double v = std::min(x, kFarWhite);
    const double over = (kCurveOver[0] * v + kCurveOver[1]) * v + kCurveOver[2];
    const double under = (kCurveUnder[0] * v + kCurveUnder[1]) * v + kCurveUnder[2];
    return std::clamp(over / under, 0.0, 1.0);
}

/// Where the curve reaches `level`: the positive root of a quadratic.
double inverse_tone(double level)
{
    const double a = kCurveOver[0] - level * kCurveUnder[0];
    const double half_b = (kCurveOver[1] - level * kCurveUnder[1]) / (2 * a);
    const double c = (kCurveOver[2] - level * kCurveUnder[2]) / a;
    return -half_b + std::sqrt(half_b * half_b - c);
}

template <typename Of> std::vector<Color> colors(std::span<const float> values, Of&& of)
{
    std::vector<Color> result(values.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = {of(static_cast<double>(values[3 * i])),
            of(static_cast<double>(values[3 * i + 1])), of(static_cast<double>(values[3 * i + 2]))};
    return result;
}

void expect_pictures(std::span<const float> test, std::span<const float> reference, ImageSize size)
{
    expect_comparable(test, reference);
    if (test.size() != 3 * size.pixels())
        throw MetricError("FLIP: found " + std::to_string(test.size()) + " values, expected "
            + std::to_string(3 * size.pixels()));
}

}  // namespace

FlipExposures flip_exposures(std::span<const float> reference_linear)
{
    std::vector<double> all = luminances(reference_linear);
    const auto median_of = [&] {
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end());
        return *middle;
    };
    double median = all.empty() ? 0 : median_of();
    if (!(median > 0)) {
        std::erase_if(all, [](double l) { return !(l > 0); });
        if (all.empty())
            return {};
        median = median_of();
    }
    const double highest = *std::max_element(all.begin(), all.end());
    const double white = inverse_tone(kWhiteLevel);
    const double start = std::log2(white / highest);
    const double stop = std::log2(white / median);
    return {start, stop, std::max(2, static_cast<int>(std::ceil(stop - start)))};
}

std::vector<float> ldr_flip(std::span<const float> test_display,
    std::span<const float> reference_display, ImageSize size, double pixels_per_degree)
{
    expect_pictures(test_display, reference_display, size);
    const auto decode = [](double x) { return srgb_decode(std::clamp(x, 0.0, 1.0)); };
    return flip_of_screens(
        colors(test_display, decode), colors(reference_display, decode), size, pixels_per_degree);
}

std::vector<float> hdr_flip(std::span<const float> test_linear,
    std::span<const float> reference_linear, ImageSize size, double pixels_per_degree,
    const std::optional<FlipExposures>& exposures)
{
    expect_pictures(test_linear, reference_linear, size);
    const FlipExposures range = exposures.value_or(flip_exposures(reference_linear));
    std::vector<float> errors(size.pixels(), 0.0F);
    for (int i = 0; i < range.count; ++i) {
        const double stops =
            range.start + i * (range.stop - range.start) / std::max(range.count - 1, 1);
        const auto shown = [scale = std::exp2(stops)](
                               double x) { return tone(std::max(x, 0.0) * scale); };
        const std::vector<float> here = flip_of_screens(
            colors(test_linear, shown), colors(reference_linear, shown), size, pixels_per_degree);
        std::transform(errors.begin(), errors.end(), here.begin(), errors.begin(),
            [](float a, float b) { return std::max(a, b); });
    }
    return errors;
}

Pooled pool(std::span<const float> errors, Mask mask)
{
    expect_fitting(mask, errors.size());
    std::vector<double> sorted;
    for (std::size_t i = 0; i < errors.size(); ++i)
        if (mask.empty() || mask[i] != 0)
            sorted.push_back(static_cast<double>(errors[i]));
    if (sorted.empty())
        throw MetricError("no pixel to pool");
    std::sort(sorted.begin(), sorted.end());
    const double sum = std::accumulate(sorted.begin(), sorted.end(), 0.0);
    const auto weighted = [&](double share) {
        double below = 0;
        for (const double error : sorted)
            if ((below += error) >= share * sum)
                return error;
        return sorted.back();
    };
    return {.mean = sum / static_cast<double>(sorted.size()),
        .weighted_median = weighted(0.5),
        .first_quartile = weighted(0.25),
        .third_quartile = weighted(0.75),
        .lowest = sorted.front(),
        .highest = sorted.back()};
}

}  // namespace farlight::client
