// How error falls with time: MSE(t) = b^2 + c / t, and what follows from it.
#pragma once

#include "client/accuracy/frontier.h"

#include <optional>
#include <vector>

namespace farlight::client {

/// error(t) = floor + rate / t
struct ErrorFit {
    double floor = 0;  ///< b^2, >= 0: the bias that no time removes.
    double rate = 0;  ///< c [error * ms], >= 0
};

/// Least squares of the relative deviations, floor and rate not below 0. With a `floor` that is
/// known (0: unbiased; a bias that was measured) the rate alone is fitted, and one point is enough;
/// else two at different times are needed. Nothing for fewer. Points that are not measured do not
/// count.
std::optional<ErrorFit> fit_error(
    const std::vector<TimedError>& all, std::optional<double> floor = {});

/// Slope of log(error) over log(time) of what is measured by least squares; nothing for less than
/// two points at different times.
std::optional<double> log_slope(const std::vector<TimedError>& all);

/// The time from which the unbiased method has less error than the other one [ms]:
/// t* = (c_unbiased - c_other) / b_other^2. 0: at all times. Nothing: never, b^2 is 0.
std::optional<double> crossing(const ErrorFit& unbiased, const ErrorFit& other);

}  // namespace farlight::client
