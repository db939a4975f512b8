// Turns, and medians over them.
#include "client/accuracy/times.h"

#include "client/accuracy/errors.h"
#include "client/metrics/turns.h"

#include <algorithm>

namespace farlight::client {
namespace {

using nlohmann::json;

constexpr double kMsPerUs = 0.001;

void append_values(std::vector<double>& to, const std::vector<double>& from)
{
    to.insert(to.end(), from.begin(), from.end());
}

std::vector<double>& times_of_pass(FrameTimes& times, const std::string& name)
{
    for (auto& [known, values] : times.passes)
        if (known == name)
            return values;
    return times.passes.emplace_back(name, std::vector<double>()).second;
}

std::vector<TurnValues> by_turns(const FrameTimes& times)
{
    if (times.turns.empty())
        return {times.passes_sum};
    std::vector<TurnValues> turns;
    auto first = times.passes_sum.begin();
    for (const std::size_t frames : times.turns) {
        const auto last = first + static_cast<std::ptrdiff_t>(frames);
        turns.emplace_back(first, last);
        first = last;
    }
    return turns;
}

FrameTimes take_turn(Rig& rig, const SweepPoint& point, const TimePlan& plan)
{
    rig.choose(point.settings);
    for (int i = 0; i < plan.settling; ++i)
        rig.draw();
    FrameTimes times;
    for (int i = 0; i < plan.frames; ++i)
        times.add(rig.draw().header);
    return times;
}

}  // namespace

void FrameTimes::add(const protocol::FrameHeader& header)
{
    double sum = 0;
    for (const protocol::PassEntry& pass : header.passes) {
        times_of_pass(*this, pass.name).push_back(static_cast<double>(pass.milliseconds));
        sum += static_cast<double>(pass.milliseconds);
    }
    passes_sum.push_back(sum);
    if (header.frame_us > 0)
        whole.push_back(kMsPerUs * header.frame_us);
    encode.push_back(kMsPerUs * header.encode_us);
}

void FrameTimes::append(const FrameTimes& turn)
{
    turns.push_back(turn.passes_sum.size());
    append_values(passes_sum, turn.passes_sum);
    append_values(whole, turn.whole);
    append_values(encode, turn.encode);
    for (const auto& [name, values] : turn.passes)
        append_values(times_of_pass(*this, name), values);
}

json to_json(const FrameTimes& times)
{
    return {{"passes_sum", times.passes_sum}, {"whole", times.whole}, {"encode", times.encode},
        {"passes", times.passes}};
}

FrameTimes frame_times_of(const json& json)
{
    FrameTimes times;
    json.at("passes_sum").get_to(times.passes_sum);
    json.at("whole").get_to(times.whole);
    json.at("encode").get_to(times.encode);
    json.at("passes").get_to(times.passes);
    return times;
}

std::vector<FrameTimes> measure_times(Rig& rig, const std::vector<SweepPoint>& points,
    const TimePlan& plan, Journal& journal, Progress& progress)
{
    std::vector<FrameTimes> all(points.size());
    rig.choose(plan.settings);
    for (int round = 0; round < plan.rounds; ++round) {
        progress.phase(
            "times, round " + std::to_string(round + 1) + " of " + std::to_string(plan.rounds));
        for (std::size_t turn = 0; turn < points.size(); ++turn) {
            const std::size_t at = round % 2 == 0 ? turn : points.size() - 1 - turn;
            const std::string name = "times " + std::to_string(round) + " " + points[at].id();
            if (const json* known = journal.find(name)) {
                all[at].append(frame_times_of(*known));
                progress.drop(work_of(points[at].settings) * (plan.settling + plan.frames));
                continue;
            }
            const FrameTimes times = take_turn(rig, points[at], plan);
            journal.add(name, to_json(times));
            all[at].append(times);
        }
    }
    return all;
}

double work_of_times(const std::vector<SweepPoint>& points, const TimePlan& plan)
{
    double work = 0;
    for (const SweepPoint& point : points)
        work += work_of(point.settings) * (plan.settling + plan.frames) * plan.rounds;
    return work;
}

json summary_of(const FrameTimes& times)
{
    json passes = json::array();
    for (const auto& [name, values] : times.passes)
        passes.push_back({{"name", name}, {"ms", median(values)}});
    json summary{{"ms", json_of(median_of_turns(by_turns(times)))}, {"passes", passes},
        {"encode_ms", median(times.encode)}, {"frames", times.passes_sum.size()}};
    if (!times.whole.empty())
        summary["whole_ms"] = median(times.whole);
    return summary;
}

}  // namespace farlight::client
