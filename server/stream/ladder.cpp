// Candidates, and the frontier among them.
#include "server/stream/ladder.h"

#include <algorithm>
#include <limits>

namespace farlight {
namespace {

/// Each draws about 0.7 of the pixels of the next.
constexpr float kScales[] = {0.25F, 0.3F, 0.35F, 0.42F, 0.5F, 0.6F, 0.7F, 0.84F, 1};
constexpr int kSamples[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
/// A-trous iterations left out in the cheapest choices.
constexpr int kLeftOut[] = {4, 2};

/// What decides which of two choices is better.
double badness_of(const Rung& rung)
{
    return rung.error ? rung.error->value : 1 / strength_of(rung.choice);
}

}  // namespace

std::vector<Choice> candidate_choices(const RenderSettings& wishes, int most_samples)
{
    const int iterations = wishes.atrous_iterations;
    std::vector<Choice> choices;
    const bool filters = wishes.denoiser == Denoiser::kSvgf;
    for (const int left_out : kLeftOut)
        if (filters && iterations > left_out)
            choices.push_back({kScales[0], 1, iterations - left_out});
    for (const float scale : kScales)
        if (scale < wishes.resolution_scale)
            choices.push_back({scale, 1, iterations});
    for (const int samples : kSamples)
        if (samples <= std::max(most_samples, 1))
            choices.push_back({wishes.resolution_scale, samples, iterations});
    return choices;
}

std::vector<Rung> frontier_of(std::vector<Rung> rungs)
{
    std::sort(rungs.begin(), rungs.end(), [](const Rung& a, const Rung& b) {
        return a.ms < b.ms || (a.ms == b.ms && badness_of(a) < badness_of(b));
    });
    std::vector<Rung> frontier;
    double least = std::numeric_limits<double>::infinity();
    for (Rung& rung : rungs)
        if (badness_of(rung) < least) {
            least = badness_of(rung);
            frontier.push_back(std::move(rung));
        }
    return frontier;
}

}  // namespace farlight
