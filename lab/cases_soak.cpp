// What long runs do: equal frames without end, a camera that drifts for hours, counters that wrap.
#include "lab/device_scene.h"
#include "lab/groups.h"
#include "lab/whole_filter.h"
#include "server/render/frame_counts.h"
#include "server/stream/pacing.h"

#include <cmath>

namespace farlight::lab {
namespace {

/// No rounding adds up, no history outgrows its limit, no variance appears.
void equal_frames(Findings& findings, Length length)
{
    const int frames = length == Length::kLong ? 100'000 : 1000;
    const glm::vec3 light(0.1F, 3e-5F, 6e4F);
    WholeFilter filter([](int, int) { return wall_at(kWallDepth); });
    const Texels input(place_of(0, kFiltered.height), glm::vec4(light, 0));
    filter.frame(input);
    for (int i = 2; i < frames; ++i)
        filter.repeat();
    double off = 0;
    double variance = 0;
    for (const glm::vec4& texel : filter.frame(input)) {
        for (int c = 0; c < 3; ++c)
            off = farther(off, std::abs(static_cast<double>(texel[c]) / light[c] - 1));
        variance = farther(variance, static_cast<double>(variance_of(texel.w)));
    }
    findings.at_most("relative drift after " + std::to_string(frames) + " frames", off, 1e-5);
    findings.at_most("variance of equal frames", variance, 1e-30);
    findings.at_least(
        "shortest history [frames]", filter.shortest_history(), RenderSettings{}.history_max);
    findings.at_most(
        "longest history [frames]", filter.longest_history(), RenderSettings{}.history_max);
    findings.none("values that were no light", filter.bad_values().all());
}

constexpr Extent kDriftExtent{64, 48};

/// The shadows of a fence by a point of light on a wall: sharp, and without noise.
Scene fence()
{
    Scene scene;
    scene.materials.push_back({"white", glm::vec3(0.8F)});
    scene.objects.push_back({"wall", 0, Quad{{-6, -6, 0}, {12, 0, 0}, {0, 12, 0}}});
    for (int i = -6; i < 6; ++i)
        scene.objects.push_back(
            {"post", 0, Quad{{i * 0.5 + 0.013, -6, 3.5}, {0.25, 0, 0}, {0, 12, 0}}});
    PunctualLight lamp;
    lamp.name = "lamp";
    lamp.intensity = glm::vec3(40);
    lamp.position = {0.1, 0.2, 5};
    scene.lights.push_back(lamp);
    scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 50};
    return scene;
}

RenderRequest fence_request(const Scene& scene, double right, int iterations)
{
    RenderSettings settings;
    settings.max_depth = 2;
    settings.history_max = 4096;
    settings.atrous_iterations = iterations;
    RenderRequest request = linear_request(scene, kDriftExtent, settings);
    request.camera.position.x += right;
    request.camera.target.x += right;
    return request;
}

/// Sum of squared differences between neighbours.
double gradient_energy(const Image& image)
{
    double energy = 0;
    for (int y = 0; y < kDriftExtent.height; ++y)
        for (int x = 0; x + 1 < kDriftExtent.width; ++x) {
            const double step = static_cast<double>(pixel(image, x + 1, y).y)
                - static_cast<double>(pixel(image, x, y).y);
            energy += step * step;
        }
    return energy;
}

/// Of the sharpness of a picture at rest, what is left of it after `frames` of a drift by
/// `pixels` each.
struct Drift {
    double pixels;
    int frames;
    int iterations;  ///< Of the wavelet filter.
};

double sharpness_left(const DeviceScene& scene, const Drift& drift)
{
    const double pixel_width =
        2 * 3 * std::tan(glm::radians(25.0)) / static_cast<double>(kDriftExtent.height);
    View drifting(scene.shared);
    Image drifted;
    for (int i = 0; i < drift.frames; ++i)
        drifted = drifting
                      .render(fence_request(
                          scene.scene, i * drift.pixels * pixel_width, drift.iterations))
                      .image;
    View resting(scene.shared);
    Image rested;
    for (int i = 0; i < 40; ++i)  // the blur of the first frames is gone
        rested = resting
                     .render(fence_request(scene.scene,
                         (drift.frames - 1) * drift.pixels * pixel_width, drift.iterations))
                     .image;
    return gradient_energy(drifted) / gradient_energy(rested);
}

void small_drift(Findings& findings, Length length)
{
    const DeviceScene scene(fence());
    const int many = length == Length::kLong ? 10'000 : 100;
    for (const Drift& drift : {Drift{1e-4, many, 5}, Drift{3e-3, 150, 5}, Drift{3e-3, 150, 0}})
        findings.at_least("sharpness left after " + std::to_string(drift.frames)
                + " frames of a drift by " + std::to_string(drift.pixels) + " px, "
                + std::to_string(drift.iterations) + " wavelet passes",
            sharpness_left(scene, drift), 0.8);
}

/// Years of frames: what numbers samples goes on, what says how many there are stays at the most,
/// and acknowledgements are understood when frame ids begin anew.
void counters_go_on(Findings& findings, Length /*length*/)
{
    const FrameChange rests{.has_history = true, .same_samples = true, .averages = true};
    double wrong = 0;
    for (const std::uint64_t frames : {(1ULL << 24U) - 2, (1ULL << 31U) - 2, (1ULL << 32U) - 2})
        for (const int samples : {1, 3, 1024}) {
            FrameCounts counts(frames, samples);
            for (std::uint64_t i = frames; i < frames + 4; ++i) {
                counts.begin(rests);
                const std::uint64_t most = FrameCounts::kMost;
                const std::uint64_t expected = std::min(i + 1, most);
                const std::uint64_t drawn =
                    std::min<std::uint64_t>(expected * static_cast<std::uint64_t>(samples),
                        std::numeric_limits<std::uint32_t>::max());
                wrong += static_cast<std::uint64_t>(counts.mean()) == expected ? 0 : 1;
                wrong += static_cast<std::uint64_t>(counts.still()) == expected ? 0 : 1;
                wrong += counts.samples(samples) == drawn ? 0 : 1;
                wrong += counts.frame_index() == static_cast<std::uint32_t>(i) ? 0 : 1;
                wrong += counts.first_sample()
                        == static_cast<std::uint32_t>(i * static_cast<std::uint64_t>(samples))
                    ? 0
                    : 1;
                counts.end(samples);
            }
        }
    double unacknowledged = 0;
    for (const std::uint32_t last : {(1U << 24U) - 2, (1U << 31U) - 2, 0U - 2}) {
        Pacing pacing(4, last);
        for (std::uint32_t i = 1; i <= 4; ++i) {
            pacing.started();
            pacing.sent(last + i, {}, std::nullopt);
        }
        unacknowledged += pacing.acknowledge(last + 5, {}) ? 1 : 0;
        for (std::uint32_t i = 1; i <= 4; ++i)
            unacknowledged += pacing.acknowledge(last + i, {}) ? 0 : 1;
    }
    findings.none("counts that are wrong past 2^24, 2^31 and 2^32 frames", wrong);
    findings.none("acknowledgements misunderstood there", unacknowledged);
}

constexpr Case kSoakCases[] = {
    {"48b", "soak", "years of frames", Layer::kFunction,
        "Counts of frames go on or stop at the most past 2^24, 2^31 and 2^32.", counters_go_on},
    {"55b", "soak", "equal frames", Layer::kSequence,
        "The whole filter leaves constant light constant for a hundred thousand frames.",
        equal_frames},
    {"64b", "soak", "hours of drift", Layer::kSequence,
        "A camera that drifts by fractions of a pixel a frame leaves a picture sharp.",
        small_drift},
};

constexpr Guard kSoakGuards[] = {
    {"ids_wrap_round", "48b"},
    {"least_alpha", "64b", "svgf/temporal.comp",
        "const float alpha = max(least_alpha(p), 1.0 / length);",
        "const float alpha = max(1e-6 * least_alpha(p), 1.0 / length);"},
    {"longest_history", "55b", "svgf/temporal.comp",
        "length = min(old.least_length + length, float(history_max));",
        "length = min(old.least_length + length, 1e6 * float(history_max));"},
};

}  // namespace

Group soak_group()
{
    return {kSoakCases, kSoakGuards};
}

}  // namespace farlight::lab
