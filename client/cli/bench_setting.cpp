// Two values of a setting take turns in one session, A B B A, so that neither heat nor other
// programs favour one. A changed setting keeps histories, so each frame is drawn as in a session
// that has the value for long, but for the first after a change, which is not counted.
#include "client/cli/bench_setting.h"

#include "client/camera_path.h"
#include "client/cli/command.h"
#include "client/metrics/bootstrap.h"
#include "client/session.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>

namespace farlight::client {
namespace {

constexpr double kDegreesPerFrame = 1;
constexpr int kWarmUpTurns = 4;
constexpr std::chrono::seconds kPatience{120};

struct Turns {
    std::string key;
    std::string values[2];
};

Turns parse_turns(const std::string& text)
{
    const auto equals = text.find('=');
    const auto comma = text.find(',', equals == std::string::npos ? 0 : equals);
    if (equals == std::string::npos || comma == std::string::npos)
        throw std::invalid_argument("--turns " + text + ": expected KEY=A,B");
    return {text.substr(0, equals),
        {text.substr(equals + 1, comma - equals - 1), text.substr(comma + 1)}};
}

/// Milliseconds by pass, in the order of execution; of a pass that a frame lacks there are fewer.
using PassSamples = std::vector<std::pair<std::string, std::vector<double>>>;

void add(PassSamples& samples, const std::string& name, double ms)
{
    const auto found = std::find_if(
        samples.begin(), samples.end(), [&](const auto& pass) { return pass.first == name; });
    if (found != samples.end())
        found->second.push_back(ms);
    else
        samples.push_back({name, {ms}});
}

struct Side {
    std::vector<double> frame_ms;
    PassSamples passes;
};

class SettingBench {
public:
    SettingBench(const Target& target, Turns turns)
        : session_(
            target.url(), target.hello(protocol::Mode::kLockstep, protocol::Format::kJpeg420))
        , turns_(std::move(turns))
    {
        for (const std::string& value : turns_.values) {
            session_.set(turns_.key, value);
            session_.await_own_programs(session_.welcome().camera, kPatience);
        }
    }

    void take_turn(int which, bool counts)
    {
        session_.set(turns_.key, turns_.values[which]);
        draw();
        const auto header = draw();
        if (!counts)
            return;
        Side& side = sides[which];
        side.frame_ms.push_back((header.trace_us + header.denoise_us) / 1000.0);
        for (const auto& pass : header.passes)
            add(side.passes, pass.name, static_cast<double>(pass.milliseconds));
    }

    Side sides[2];

private:
    protocol::FrameHeader draw()
    {
        const protocol::Welcome& welcome = session_.welcome();
        const double angle = kDegreesPerFrame * (frame_++ % 30);
        return session_.draw(orbit(welcome.camera, middle_of(welcome.scene), angle)).header;
    }

    Session session_;
    Turns turns_;
    int frame_ = 0;
};

double median_of(const PassSamples& samples, const std::string& name)
{
    for (const auto& [pass, ms] : samples)
        if (pass == name)
            return median(ms);
    return 0;
}

void print(const Turns& turns, const SettingBench& bench, const RatioOfMedians& ratio)
{
    std::printf("%s, median milliseconds\n  %-28s %10s %10s\n", turns.key.c_str(), "",
        turns.values[0].c_str(), turns.values[1].c_str());
    PassSamples all = bench.sides[0].passes;
    for (const auto& [name, ms] : bench.sides[1].passes)
        if (median_of(all, name) == 0)
            all.push_back({name, {}});
    for (const auto& [name, ms] : all)
        std::printf("  %-28s %10.2f %10.2f\n", name.c_str(), median_of(bench.sides[0].passes, name),
            median_of(bench.sides[1].passes, name));
    std::printf("  %-28s %10.2f %10.2f\n", "= frame", median(bench.sides[0].frame_ms),
        median(bench.sides[1].frame_ms));
    std::printf("  %s / %s: %.3f (%.3f to %.3f)\n", turns.values[1].c_str(),
        turns.values[0].c_str(), ratio.ratio, ratio.interval.lower, ratio.interval.upper);
}

}  // namespace

int bench_setting(const TargetOptions& options, const std::string& text, int frames, bool json)
{
    const Turns turns = parse_turns(text);
    const Target target(options);
    SettingBench bench(target, turns);
    for (int i = -kWarmUpTurns; i < frames; ++i) {
        const int first = i % 2 == 0 ? 0 : 1;
        bench.take_turn(first, i >= 0);
        bench.take_turn(1 - first, i >= 0);
    }
    const RatioOfMedians ratio = ratio_of_medians(bench.sides[1].frame_ms, bench.sides[0].frame_ms);
    if (!json) {
        print(turns, bench, ratio);
        return kDone;
    }
    nlohmann::json result{{"setting", turns.key}, {"ratio", ratio.ratio},
        {"ratio_lower", ratio.interval.lower}, {"ratio_upper", ratio.interval.upper}};
    for (int which = 0; which < 2; ++which) {
        nlohmann::json passes = nlohmann::json::array();
        for (const auto& [name, ms] : bench.sides[which].passes)
            passes.push_back({{"name", name}, {"median_ms", median(ms)}});
        result["values"].push_back({{"value", turns.values[which]},
            {"median_ms", median(bench.sides[which].frame_ms)}, {"passes", passes}});
    }
    print_json(result);
    return kDone;
}

}  // namespace farlight::client
