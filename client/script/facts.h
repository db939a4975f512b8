// The functions that expectations may call, for one played script.
#pragma once

#include "client/metrics/display.h"
#include "client/script/play.h"

namespace farlight::client {

class Facts {
public:
    /// Both must outlive it.
    Facts(const Script& script, const Played& played);

    /// The value of a call; 1 and 0 of yes-or-no functions. Throws MetricError when a metric has
    /// none: a mean would hide non-finite values, no pixel is newly revealed ...
    double operator()(const Call& call) const;

private:
    double of_run(const Call& call, const PlayedRun& run) const;
    /// A metric of one frame against the reference.
    double of_frame(std::string_view metric, const Picture& picture) const;
    double of_sequence(std::string_view metric, const PlayedSequence& sequence) const;
    double lag(const PlayedRun& run, int first) const;
    double of_all_runs(std::string_view metric) const;
    const Picture& reference() const { return *played_.reference; }

    const Script& script_;
    const Played& played_;
    DisplayOptions display_;  ///< By the settings of all runs.
};

}  // namespace farlight::client
