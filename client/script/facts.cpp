// One branch a function; what each computes is in client/metrics/.
#include "client/script/facts.h"

#include "client/metrics/compare.h"
#include "client/metrics/ensemble.h"

#include <algorithm>

namespace farlight::client {
namespace {

constexpr double kLeastLitShare = 0.01;  // see `not_black` in kFunctions

DisplayOptions display_of(const Settings& settings)
{
    DisplayOptions options;
    if (const auto found = settings.find("exposure");
        found != settings.end() && found->second.is_number())
        options.exposure = found->second.get<double>();
    if (const auto found = settings.find("tonemap");
        found != settings.end() && found->second == "linear")
        options.curve = ToneCurve::kLinear;
    return options;
}

double nonfinite_in(const PlayedRun& run)
{
    double count = 0;
    for (const FrameFacts& frame : run.frames)
        count += static_cast<double>(frame.nonfinite);
    return count;
}

bool same_bytes(const PlayedRun& run)
{
    return std::equal(run.frames.begin(), run.frames.end(), run.again.begin(), run.again.end(),
        [](const FrameFacts& a, const FrameFacts& b) { return a.hash == b.hash; });
}

}  // namespace

Facts::Facts(const Script& script, const Played& played)
    : script_(script)
    , played_(played)
    , display_(display_of(script.settings))
{
}

double Facts::operator()(const Call& call) const
{
    const Function& function = *call.function;
    if (function.of == Of::kAllRuns)
        return of_all_runs(function.name);
    if (function.of != Of::kRunOrAll)
        return of_run(call, played_.runs.at(call.run));
    double sum = 0;
    for (const auto& [name, run] : played_.runs) {
        if (!call.run.empty() && call.run != name)
            continue;
        if (function.name == "not_black")
            sum += share_lit(run.pictures.at(script_.frames - 1).linear) > kLeastLitShare ? 0 : 1;
        else if (function.name == "same_bytes_twice")
            sum += same_bytes(run) ? 0 : 1;
        else
            sum += nonfinite_in(run);
    }
    // Of a yes-or-no function the runs that say no were counted.
    return function.predicate ? (sum == 0 ? 1 : 0) : sum;
}

double Facts::of_run(const Call& call, const PlayedRun& run) const
{
    const std::string_view name = call.function->name;
    const int last = script_.frames - 1;
    if (name == "frames")
        return static_cast<double>(run.frames.size());
    if (name == "history_resets")
        return static_cast<double>(std::count_if(run.frames.begin(), run.frames.end(),
            [](const FrameFacts& facts) { return facts.history_reset; }));
    if (name == "ghost")
        return ghost_residue(run.pictures.at(last).linear, reference().linear, run.revealed);
    if (name == "lag")
        return lag(run, call.frame.value_or(0));
    if (call.function->of == Of::kFramesFrom)
        return of_sequence(name, run.sequences.at(call.frame.value_or(0)));
    const int frame = call.frame.value_or(last);
    if (name == "samples")
        return run.frames.at(static_cast<std::size_t>(frame)).samples;
    const Picture& picture = run.pictures.at(frame);
    if (name == "mean")
        return mean_value(picture.linear);
    if (name == "max")
        return largest_value(picture.linear);
    return of_frame(name, picture);
}

double Facts::of_frame(std::string_view metric, const Picture& picture) const
{
    return metric_value(metric, appearance_of(picture, display_),
        appearance_of(reference(), display_), {.display = display_});
}

double Facts::of_sequence(std::string_view metric, const PlayedSequence& sequence) const
{
    if (sequence.nonfinite > 0)
        throw MetricError(
            std::to_string(sequence.nonfinite) + " values of the frames are not finite");
    return metric == "flicker" ? sequence.meter.flicker() : sequence.meter.successive_difference();
}

double Facts::lag(const PlayedRun& run, int first) const
{
    std::vector<double> errors;
    for (auto frame = run.pictures.lower_bound(first); frame != run.pictures.end(); ++frame)
        errors.push_back(relative_mse(frame->second.linear, reference().linear));
    return lag_frames(errors);
}

double Facts::of_all_runs(std::string_view metric) const
{
    std::vector<std::span<const float>> runs;
    for (const auto& [name, run] : played_.runs)
        runs.emplace_back(run.pictures.at(script_.frames - 1).linear);
    const Ensemble ensemble(runs, reference().linear);
    return metric == "bias" ? ensemble.bias() : ensemble.variance();
}

}  // namespace farlight::client
