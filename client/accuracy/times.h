// What each point of a sweep takes: milliseconds a pass from frame headers. The points take turns,
// in one order and then in the reverse (A B B A), so that neither heat nor other programs favour
// one; a part of every turn is thrown away, in which histories fill.
#pragma once

#include "client/accuracy/grid.h"
#include "client/accuracy/journal.h"
#include "client/accuracy/rig.h"

namespace farlight::client {

struct TimePlan {
    int rounds = 6;  ///< Even, so that no order is the more frequent one.
    int settling = 5;  ///< Frames of a turn that do not count.
    int frames = 3;  ///< Frames of a turn that do.
    Settings settings;  ///< Of every point.
};

/// Times of frames by what took them, one value a frame [ms].
struct FrameTimes {
    std::vector<double> passes_sum;  ///< All passes together.
    std::vector<double> whole;  ///< The whole frame by its own clock; empty: the server tells none.
    std::vector<double> encode;  ///< As JPEG, apart from all else.
    std::vector<std::pair<std::string, std::vector<double>>> passes;  ///< In execution order.
    std::vector<std::size_t> turns;  ///< Frames of each appended turn; empty: all are of one.

    void add(const protocol::FrameHeader& header);
    void append(const FrameTimes& turn);
};

nlohmann::json to_json(const FrameTimes& times);
FrameTimes frame_times_of(const nlohmann::json& json);

/// One turn for each point and round, kept in the journal; all of them together by point.
std::vector<FrameTimes> measure_times(Rig& rig, const std::vector<SweepPoint>& points,
    const TimePlan& plan, Journal& journal, Progress& progress);
double work_of_times(const std::vector<SweepPoint>& points, const TimePlan& plan);

/// Medians, and the 95 % interval over turns of all passes together, as REPORT.md describes them.
nlohmann::json summary_of(const FrameTimes& times);

}  // namespace farlight::client
