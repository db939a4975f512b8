// Frames with many seeds, and what they say together.
#include "client/accuracy/errors.h"

#include "client/metrics/display.h"
#include "client/metrics/ensemble.h"
#include "client/metrics/flip.h"
#include "client/picture_file.h"

#include <algorithm>

namespace farlight::client {
namespace {

using nlohmann::json;
using Pictures = std::vector<std::vector<float>>;

/// An error below 5 standard deviations of the reference is as much the reference's as its own.
constexpr double kReferenceFactor = 5;

/// Raw samples remember nothing.
int history_of(const SweepPoint& point, const ErrorPlan& plan)
{
    return point.denoiser() == kRaw ? 0 : plan.history;
}

double mean_flip(const Pictures& pictures, const ReferencePicture& reference, int seeds)
{
    const std::vector<float> shown = display_of_linear(reference.mean);
    double sum = 0;
    const auto count = std::min(pictures.size(), static_cast<std::size_t>(seeds));
    for (std::size_t i = 0; i < count; ++i)
        sum +=
            pool(ldr_flip(display_of_linear(pictures[i]), shown, reference.size), reference.counts)
                .mean;
    return sum / static_cast<double>(count);
}

using Metric = double (*)(std::span<const float>, std::span<const float>, Mask);

double mean_over(const Pictures& pictures, const ReferencePicture& reference, Metric metric)
{
    double sum = 0;
    for (const auto& picture : pictures)
        sum += metric(picture, reference.mean, reference.counts);
    return sum / static_cast<double>(pictures.size());
}

constexpr const char* kAveragedName = "averaged_";

std::filesystem::path averaged_file(const std::filesystem::path& folder, int seed, int frames)
{
    return folder / (kAveragedName + std::to_string(seed) + "_" + std::to_string(frames) + ".pfm");
}

/// The last file of a seed appears when the others are there, and is there whole or not at all.
void draw_averaged(
    Rig& rig, int seed, const std::vector<int>& after, const std::filesystem::path& folder)
{
    rig.choose({{"seed", seed}});
    for (int frames = 1; frames <= after.back(); ++frames) {
        const Frame frame = rig.draw(/*cut=*/frames == 1);
        if (std::find(after.begin(), after.end(), frames) == after.end())
            continue;
        const std::filesystem::path file = averaged_file(folder, seed, frames);
        const std::filesystem::path unfinished = averaged_file(folder, seed, 0);
        write_picture(unfinished, linear_picture(frame));
        std::filesystem::rename(unfinished, file);
    }
}

}  // namespace

json json_of(const Estimate& estimate)
{
    return {{"value", estimate.value}, {"lower", estimate.interval.lower},
        {"upper", estimate.interval.upper}};
}

Pictures draw_seeds(Rig& rig, const SweepPoint& point, const ErrorPlan& plan)
{
    Pictures pictures;
    rig.choose(plan.settings);
    rig.choose(point.settings);
    for (int seed = 1; seed <= plan.seeds; ++seed) {
        rig.choose({{"seed", seed}});
        pictures.push_back(linear_picture(rig.draw_after(history_of(point, plan))).linear);
    }
    return pictures;
}

double work_of_seeds(const SweepPoint& point, const ErrorPlan& plan)
{
    return work_of(point.settings) * (1 + history_of(point, plan)) * plan.seeds;
}

json measured_error(const Pictures& pictures, const ReferencePicture& reference, int flip_seeds)
{
    for (const auto& picture : pictures)
        expect_comparable(picture, reference.mean);  // what does not count must be finite too
    std::vector<std::span<const float>> runs(pictures.begin(), pictures.end());
    const ErrorSplit split =
        Ensemble(runs, reference.mean, reference.variance, reference.counts).split();
    const double own = reference.own_relmse();
    const double relmse = split.relmse.value;
    // Of a black scene neither has any error.
    const bool above = relmse > 0 && relmse >= kReferenceFactor * kReferenceFactor * own;
    return {{"relmse", json_of(split.relmse)}, {"bias", json_of(split.bias)},
        {"variance", json_of(split.variance)},
        {"relmse999", mean_over(pictures, reference, relative_mse_999)},
        {"mse", mean_over(pictures, reference, mean_square_error)},
        {"fireflies", mean_over(pictures, reference, count_fireflies)},
        {"flip", mean_flip(pictures, reference, flip_seeds)}, {"reference_limited", !above}};
}

std::map<int, json> averaging_errors(Rig& rig, const ErrorPlan& plan,
    const ReferencePicture& reference, const std::vector<int>& after,
    const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder);
    rig.choose(plan.settings);
    rig.choose({{"denoiser", kAveraging}, {"samples_per_pixel", 1}});
    for (int seed = 1; seed <= plan.seeds; ++seed)
        if (!std::filesystem::exists(averaged_file(folder, seed, after.back())))
            draw_averaged(rig, seed, after, folder);
    std::map<int, json> errors;
    for (const int frames : after) {
        Pictures pictures;
        for (int seed = 1; seed <= plan.seeds; ++seed)
            pictures.push_back(read_picture(averaged_file(folder, seed, frames)).linear);
        errors[frames] = measured_error(pictures, reference, plan.flip_seeds);
    }
    remove_averaged(folder);
    return errors;
}

void remove_averaged(const std::filesystem::path& folder)
{
    if (!std::filesystem::is_directory(folder))
        return;
    std::vector<std::filesystem::path> ours;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".pfm"
            && entry.path().filename().string().starts_with(kAveragedName))
            ours.push_back(entry.path());
    for (const std::filesystem::path& file : ours)
        std::filesystem::remove(file);
    if (std::filesystem::is_empty(folder))
        std::filesystem::remove(folder);
}

double work_of_averaging(const ErrorPlan& plan, const std::vector<int>& after)
{
    return work_of({{"denoiser", kAveraging}, {"samples_per_pixel", 1}}) * after.back()
        * plan.seeds;
}

}  // namespace farlight::client
