// Batches of the averaging denoiser.
#include "client/accuracy/reference.h"

#include "client/accuracy/grid.h"
#include "client/metrics/ensemble.h"
#include "client/picture_file.h"

#include <algorithm>
#include <cassert>

namespace farlight::client {
namespace {

/// Keeps a frame short enough for any server's watchdog.
constexpr double kSamplesPerFrame = 4e6;
constexpr int kMaxSamplesPerPixel = 256;

constexpr const char* kUnfinishedFile = "unfinished.pfm";

/// "batch_" and digits.
bool is_batch(const std::filesystem::path& file)
{
    const std::string name = file.stem();
    return file.extension() == ".pfm" && name.starts_with("batch_")
        && name.find_first_not_of("0123456789", 6) == std::string::npos;
}

struct BatchPlan {
    int samples_per_frame;
    int frames;
};

BatchPlan batch_plan(const ReferencePlan& plan, std::size_t pixels)
{
    const int wanted = (plan.samples + plan.batches - 1) / plan.batches;
    const int per_frame =
        std::clamp(static_cast<int>(kSamplesPerFrame / static_cast<double>(pixels)), 1,
            std::min(kMaxSamplesPerPixel, wanted));
    return {per_frame, (wanted + per_frame - 1) / per_frame};
}

Picture draw_batch(Rig& rig, const ReferencePlan& plan, int batch)
{
    const auto [width, height] = rig.welcome().size;
    const BatchPlan frames = batch_plan(plan, static_cast<std::size_t>(width) * height);
    Settings settings = plan.settings;
    settings["denoiser"] = kAveraging;
    settings["samples_per_pixel"] = frames.samples_per_frame;
    settings["seed"] = kFirstReferenceSeed + static_cast<std::uint32_t>(batch);
    rig.choose(settings);
    Frame frame = rig.draw(/*cut=*/true);
    for (int i = 1; i < frames.frames; ++i)
        frame = rig.draw();
    return linear_picture(frame);
}

/// Whether the batches differ in a pixel, that is, whether its light is left to chance.
bool differ_at(const std::vector<Picture>& batches, std::size_t pixel)
{
    return std::any_of(batches.begin(), batches.end(), [&](const Picture& batch) {
        const auto value = [&](const Picture& picture) {
            return picture.linear.begin() + static_cast<std::ptrdiff_t>(3 * pixel);
        };
        return !std::equal(value(batch), value(batch) + 3, value(batches.front()));
    });
}

std::vector<std::uint8_t> pixels_that_count(
    const std::vector<Picture>& batches, std::span<const float> depth)
{
    std::vector<std::uint8_t> counts(depth.size() / 3);
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = depth[3 * i] > 0 || differ_at(batches, i) ? 1 : 0;
    if (std::count(counts.begin(), counts.end(), 0) == std::ssize(counts))
        counts.clear();
    return counts;
}

}  // namespace

double ReferencePlan::work(const protocol::Size& size) const
{
    const BatchPlan plan = batch_plan(*this, static_cast<std::size_t>(size[0]) * size[1]);
    return work_of({{"denoiser", kAveraging}, {"samples_per_pixel", plan.samples_per_frame}})
        * plan.frames * batches;
}

double ReferencePicture::own_relmse() const
{
    double sum = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
        const double r = static_cast<double>(mean[i]);
        if (counts.empty() || counts[i / 3] != 0)
            sum += static_cast<double>(variance[i]) / (r * r + kRelMseEpsilon);
    }
    return sum / (counted_share() * static_cast<double>(mean.size()));
}

double ReferencePicture::counted_share() const
{
    if (counts.empty())
        return 1;
    return 1
        - static_cast<double>(std::count(counts.begin(), counts.end(), 0))
        / static_cast<double>(counts.size());
}

void remove_batches(const std::filesystem::path& folder)
{
    if (!std::filesystem::is_directory(folder))
        return;
    std::vector<std::filesystem::path> ours;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file()
            && (is_batch(entry.path()) || entry.path().filename() == kUnfinishedFile))
            ours.push_back(entry.path());
    for (const std::filesystem::path& file : ours)
        std::filesystem::remove(file);
}

ReferencePicture reference_of(const std::vector<Picture>& batches, std::span<const float> depth)
{
    assert(batches.size() >= 2);
    std::vector<std::span<const float>> runs;
    runs.reserve(batches.size());
    for (const Picture& batch : batches)
        runs.emplace_back(batch.linear);
    ReferencePicture reference{.size = {batches.front().width, batches.front().height},
        .mean = mean_picture(runs),
        .variance = variance_picture(runs),
        .counts = pixels_that_count(batches, depth)};
    for (float& value : reference.variance)
        value /= static_cast<float>(batches.size());
    return reference;
}

ReferencePicture draw_reference(
    Rig& rig, const ReferencePlan& plan, const std::filesystem::path& folder, Progress& progress)
{
    std::vector<Picture> batches;
    const double work = plan.work(rig.welcome().size) / plan.batches;
    for (int i = 0; i < plan.batches; ++i) {
        const std::filesystem::path file = folder / ("batch_" + std::to_string(i) + ".pfm");
        if (!folder.empty() && std::filesystem::exists(file)) {
            batches.push_back(read_picture(file));
            progress.drop(work);
            continue;
        }
        batches.push_back(draw_batch(rig, plan, i));
        if (folder.empty())
            continue;
        const std::filesystem::path unfinished = folder / kUnfinishedFile;
        write_picture(unfinished, batches.back());
        std::filesystem::rename(unfinished, file);  // a batch is there whole or not at all
    }
    ReferencePicture reference = reference_of(batches, rig.depth());
    const auto [width, height] = rig.welcome().size;
    const BatchPlan frames = batch_plan(plan, static_cast<std::size_t>(width) * height);
    reference.samples = frames.samples_per_frame * frames.frames * plan.batches;
    return reference;
}

}  // namespace farlight::client
