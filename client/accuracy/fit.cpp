// Two unknowns, normal equations written out.
#include "client/accuracy/fit.h"

#include <algorithm>
#include <cmath>

namespace farlight::client {
namespace {

bool at_different_times(const std::vector<TimedError>& points)
{
    return std::any_of(points.begin(), points.end(),
        [&](const TimedError& point) { return point.ms != points.front().ms; });
}

double floor_alone(const std::vector<TimedError>& points)
{
    double sum = 0;
    double squares = 0;
    for (const TimedError& point : points) {
        sum += 1 / point.error;
        squares += 1 / (point.error * point.error);
    }
    return sum / squares;
}

/// Minimises sum ((floor + rate v' - error) / error)^2 with v' = 1 / t.
double rate_above(const std::vector<TimedError>& points, double floor)
{
    double sum = 0;
    double squares = 0;
    for (const TimedError& point : points) {
        const double v = 1 / (point.ms * point.error);
        sum += v * (1 - floor / point.error);
        squares += v * v;
    }
    return std::max(0.0, sum / squares);
}

}  // namespace

std::optional<ErrorFit> fit_error(const std::vector<TimedError>& all, std::optional<double> floor)
{
    const std::vector<TimedError> points = only_measured(all);
    if (floor && !points.empty())
        return ErrorFit{*floor, rate_above(points, *floor)};
    if (points.size() < 2 || !at_different_times(points))
        return std::nullopt;
    // Minimises sum (u b^2 + v c - 1)^2 with u = 1 / error, v = 1 / (t error).
    double uu = 0, uv = 0, vv = 0, u1 = 0, v1 = 0;
    for (const TimedError& point : points) {
        const double u = 1 / point.error;
        const double v = u / point.ms;
        uu += u * u;
        uv += u * v;
        vv += v * v;
        u1 += u;
        v1 += v;
    }
    const double determinant = uu * vv - uv * uv;  // > 0: the times differ
    const ErrorFit fit{(u1 * vv - v1 * uv) / determinant, (v1 * uu - u1 * uv) / determinant};
    if (!(fit.floor >= 0))
        return ErrorFit{0, rate_above(points, 0)};
    if (!(fit.rate >= 0))
        return ErrorFit{floor_alone(points), 0};
    return fit;
}

std::optional<double> log_slope(const std::vector<TimedError>& all)
{
    const std::vector<TimedError> points = only_measured(all);
    if (points.size() < 2 || !at_different_times(points))
        return std::nullopt;
    const auto n = static_cast<double>(points.size());
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (const TimedError& point : points) {
        mean_x += std::log(point.ms) / n;
        mean_y += std::log(point.error) / n;
    }
    for (const TimedError& point : points) {
        const double x = std::log(point.ms) - mean_x;
        xx += x * x;
        xy += x * (std::log(point.error) - mean_y);
    }
    return xy / xx;
}

std::optional<double> crossing(const ErrorFit& unbiased, const ErrorFit& other)
{
    if (!(other.floor > 0))
        return std::nullopt;
    return std::max(0.0, (unbiased.rate - other.rate) / other.floor);
}

}  // namespace farlight::client
