// Sorting by time and keeping what improves.
#include "client/accuracy/frontier.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace farlight::client {

bool is_measured(const TimedError& point)
{
    const auto usable = [](double value) { return std::isfinite(value) && value > 0; };
    return usable(point.ms) && usable(point.error);
}

std::vector<TimedError> only_measured(std::vector<TimedError> points)
{
    std::erase_if(points, [](const TimedError& point) { return !is_measured(point); });
    return points;
}

std::vector<std::size_t> pareto_frontier(const std::vector<TimedError>& points)
{
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::erase_if(order, [&](std::size_t i) { return !is_measured(points[i]); });
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return points[a].ms != points[b].ms ? points[a].ms < points[b].ms
                                            : points[a].error < points[b].error;
    });
    std::vector<std::size_t> frontier;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (!(points[i].error < least))
            continue;
        least = points[i].error;
        frontier.push_back(i);
    }
    return frontier;
}

std::vector<Halving> price_list(const std::vector<TimedError>& frontier)
{
    std::vector<Halving> prices;
    for (std::size_t from = 0; from < frontier.size(); ++from) {
        Halving price{.from = from, .to = std::nullopt};
        for (std::size_t to = from + 1; to < frontier.size() && !price.to; ++to) {
            if (!(frontier[to].error <= frontier[from].error / 2))
                continue;
            price.to = to;
            price.extra_ms = frontier[to].ms - frontier[from].ms;
            price.factor = frontier[from].error / frontier[to].error;
        }
        prices.push_back(price);
    }
    return prices;
}

}  // namespace farlight::client
