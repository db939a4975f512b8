// Accumulation and precision: what many frames make of small errors.
#include "lab/groups.h"
#include "lab/pass_bench.h"
#include "server/passes/accumulate.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr Extent kOnePixel{1, 1};

/// The mean after frames 1 to `frames`, of which frame i shows `value(i)` [3].
template <typename Value> glm::vec4 mean_of_frames(int frames, const Value& value)
{
    PassBench bench("accumulate/accumulate.comp", {}, kOnePixel);
    bench.fill("in_radiance", GL_RGBA32F, glm::vec4(0));
    for (const char* name : {"prev_mean", "prev_variance", "out_mean", "out_variance"})
        bench.fill(name, mean_format(), glm::vec4(0));
    for (int i = 1; i <= frames; ++i) {
        bench.set_pixel("in_radiance", 0, 0, glm::vec4(value(i), 1));
        bench.constant("frame_count", i);
        bench.run();
        bench.swap("prev_mean", "out_mean");
        bench.swap("prev_variance", "out_variance");
    }
    return bench.read("prev_mean")[0];
}

/// Sum over a constant loses 1 % after a million additions in 32 bits; a running mean does not
/// move.
void mean_of_a_constant(Findings& findings, Length length)
{
    const glm::vec3 constants(0.1F, 1e-20F, 6e4F);
    const int frames = length == Length::kLong ? 1'000'000 : 50'000;
    const glm::vec4 mean = mean_of_frames(frames, [&](int) { return constants; });
    float off = 0;
    for (int c = 0; c < 3; ++c)
        off = farther(off, std::abs(mean[c] / constants[c] - 1));
    findings.at_most("relative drift after " + std::to_string(frames) + " frames",
        static_cast<double>(off), 1e-6);
}

/// Frames that are never the mean: every step rounds.
void mean_of_changing_frames(Findings& findings, Length length)
{
    const int frames = length == Length::kLong ? 1'000'000 : 50'000;
    const glm::vec4 mean =
        mean_of_frames(frames, [](int i) { return glm::vec3(i % 2 == 0 ? 0.3F : 0.1F); });
    findings.at_most("relative drift after " + std::to_string(frames) + " frames",
        std::abs(static_cast<double>(mean.x) / (0.5 * (0.3 + 0.1)) - 1), 2e-5);
}

constexpr Case kAccumulationCases[] = {
    {"49", "accumulation", "mean of equal frames", Layer::kFunction,
        "A running mean of equal frames stays where it is, for a million frames.",
        mean_of_a_constant},
    {"49b", "accumulation", "mean of changing frames", Layer::kFunction,
        "A running mean of frames that alternate keeps to their mean.", mean_of_changing_frames},
};

constexpr Guard kAccumulationGuards[] = {
    {"running_mean", "49", "accumulate/accumulate.comp", "mean = old + (radiance - old) / count;",
        "mean = (old * (count - 1.0) + radiance) / count;"},
    {"means_in_32_bits", "49b"},
};

}  // namespace

Group accumulation_group()
{
    return {kAccumulationCases, kAccumulationGuards};
}

}  // namespace farlight::lab
