// The Pareto frontier of time and error, and what it costs to halve the error from each of its
// points.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace farlight::client {

struct TimedError {
    double ms = 0;
    double error = 0;
};

/// Time and error are finite and above 0.
bool is_measured(const TimedError& point);
std::vector<TimedError> only_measured(std::vector<TimedError> points);

/// Indices of the points that no other one beats, ascending in time, strictly descending in error.
/// A point is beaten by one that is no worse in both and better in one; of equals the first stays.
/// Points that are not measured are on no frontier.
std::vector<std::size_t> pareto_frontier(const std::vector<TimedError>& points);

/// From one point of the frontier to the cheapest with at most half of its error.
struct Halving {
    std::size_t from = 0;  ///< Positions in the frontier.
    std::optional<std::size_t> to;  ///< Nothing measured halves it.
    double extra_ms = 0;
    double factor = 1;  ///< error(from) / error(to)
};

/// One for each point of a frontier that ascends in time and descends in error.
std::vector<Halving> price_list(const std::vector<TimedError>& frontier);

}  // namespace farlight::client
