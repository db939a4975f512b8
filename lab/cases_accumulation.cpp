// Accumulation and precision: what many frames make of small errors.
#include "lab/filter_bench.h"
#include "lab/groups.h"
#include "server/passes/accumulate.h"
#include "server/passes/svgf.h"

#include <algorithm>
#include <cmath>
#include <random>

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

/// Frames of noise, whose mean is known to the last bit.
void mean_of_noise(Findings& findings, Length length)
{
    const int frames = length == Length::kLong ? 1'000'000 : 30'000;
    std::mt19937 random(51);
    std::uniform_real_distribution<float> uniform(0, 1);
    double sum = 0;
    const glm::vec4 mean = mean_of_frames(frames, [&](int) {
        const float value = uniform(random);
        sum += static_cast<double>(value);
        return glm::vec3(value);
    });
    const double drift = std::abs(static_cast<double>(mean.x) / (sum / frames) - 1);
    // Every frame rounds, by half a ulp at most, this way or that.
    findings.at_most("relative drift after " + std::to_string(frames) + " frames", drift,
        std::ldexp(std::sqrt(frames), -24));
    // Numbers in [0, 1] deviate by 1 / sqrt(3) of their mean.
    findings.at_most(
        "drift over the standard error of the mean", drift * std::sqrt(3.0 * frames), 0.1);
}

/// The least weight that a new frame's light may have: that of a mirror's, at the least that the
/// setting allows (svgf/temporal.comp).
constexpr double kLeastWeight = 0.25 * 0.001;

/// Light that was 0.3, 1 or as it is, until it became 0.7.
void average_follows(Findings& findings, Length length)
{
    constexpr int kBefore = 4200;  // until a frame weighs the least
    const int frames = length == Length::kLong ? 60'000 : 20'000;
    const std::unique_ptr<PassBench> bench = filter_bench("temporal", kOnePixel);
    for (const char* name : {"prev_light", "prev_light_2", "out_light", "out_light_2"})
        bench->fill(name, light_history_format(), glm::vec4(0));
    bench->constant("svgf_alpha", static_cast<float>(kLeastWeight));
    bench->constant("history_max", 4096);
    const glm::vec3 before(0.3F, 1, 0.7F);
    const glm::vec3 after(0.7F);
    glm::dvec3 exact(before);
    for (int i = 1; i <= frames; ++i) {
        const glm::vec3 now = i <= kBefore ? before : after;
        bench->set_pixel("in_light", 0, 0, glm::vec4(now, 0));
        bench->constant("history_valid", i > 1 ? 1 : 0);
        bench->run();
        for (const char* what : {"light", "light_2", "moments", "length"})
            bench->swap(std::string("prev_") + what, std::string("out_") + what);
        exact += std::max(kLeastWeight, 1.0 / std::min(i, 4096)) * (glm::dvec3(now) - exact);
    }
    const glm::vec4 average = bench->read("prev_light")[0];
    double off = 0;
    for (int c = 0; c < 3; ++c)
        off = farther(off, std::abs(static_cast<double>(average[c]) / exact[c] - 1));
    findings.at_most(
        "off the exact average after " + std::to_string(frames) + " frames", off, 0.01);
}

constexpr Case kAccumulationCases[] = {
    {"49", "accumulation", "mean of equal frames", Layer::kFunction,
        "A running mean of equal frames stays where it is, for a million frames.",
        mean_of_a_constant},
    {"49b", "accumulation", "mean of changing frames", Layer::kFunction,
        "A running mean of frames that alternate keeps to their mean.", mean_of_changing_frames},
    {"50", "accumulation", "an average that follows", Layer::kFunction,
        "The exponential average of light reaches what it follows, however little a frame weighs.",
        average_follows},
    {"51", "accumulation", "mean of noise", Layer::kFunction,
        "A running mean of noise, in the format that it is kept in, is its mean.", mean_of_noise},
};

constexpr Guard kAccumulationGuards[] = {
    {"running_mean", "49", "accumulate/accumulate.comp", "mean = old + (radiance - old) / count;",
        "mean = (old * (count - 1.0) + radiance) / count;"},
    {"means_in_32_bits", "49b 51"},
    {"light_histories_in_32_bits", "50"},
};

}  // namespace

Group accumulation_group()
{
    return {kAccumulationCases, kAccumulationGuards};
}

}  // namespace farlight::lab
