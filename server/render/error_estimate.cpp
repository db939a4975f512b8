// See the header.
#include "server/render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace farlight {
namespace {

constexpr int kBlockTiles = 8;
constexpr std::size_t kFewestBlocks = 9;
/// Pairs of frames that a prediction is averaged over, and at most where it is not precise.
constexpr int kPairs = 8;
constexpr int kMostPairs = 64;

/// Two-sided 95 % quantile of Student's t: first term of its expansion about the normal one.
/// Source: Abramowitz and Stegun 1964, 26.7.5.
double t_quantile(double degrees_of_freedom)
{
    constexpr double z = 1.959964;
    return z + (z * z * z + z) / (4 * degrees_of_freedom);
}

/// Sums of `component` and what they are over, of blocks of `side` x `side` tiles.
std::vector<glm::dvec2> block_sums(
    std::span<const glm::vec4> sums, Extent extent, std::pair<int, Over> component_over, int side)
{
    const auto [component, over] = component_over;
    const Extent tiles = tiles_of(extent);
    const int across = (tiles.width + side - 1) / side;
    const int down = (tiles.height + side - 1) / side;
    std::vector<glm::dvec2> blocks(
        static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x) {
            const glm::vec4& tile = sums[static_cast<std::size_t>(x + y * tiles.width)];
            const int pixels = std::min(kTileSize, extent.width - x * kTileSize)
                * std::min(kTileSize, extent.height - y * kTileSize);
            blocks[static_cast<std::size_t>(x / side + y / side * across)] += glm::dvec2(
                tile[component], over == Over::kPairs ? tile.w : static_cast<float>(pixels));
        }
    return blocks;
}

/// Errors of two parts that are independent of each other, the second with the share `weight`.
double of_blend(double first, double second, double weight)
{
    return (1 - weight) * (1 - weight) * first + (weight > 0 ? weight * weight * second : 0);
}

}  // namespace

Extent tiles_of(Extent extent)
{
    const auto tiles = [](int pixels) { return (pixels + kTileSize - 1) / kTileSize; };
    return {tiles(extent.width), tiles(extent.height)};
}

ErrorEstimate mean_of_tiles(
    std::span<const glm::vec4> sums, Extent extent, int component, Over over)
{
    int side = kBlockTiles;
    std::vector<glm::dvec2> blocks = block_sums(sums, extent, {component, over}, side);
    while (blocks.size() < kFewestBlocks && side > 1) {
        side /= 2;
        blocks = block_sums(sums, extent, {component, over}, side);
    }
    glm::dvec2 total(0);
    for (const glm::dvec2& block : blocks)
        total += block;
    ErrorEstimate estimate;
    estimate.value = total.x / total.y;
    if (blocks.size() < 2)
        return estimate;
    double squares = 0;
    for (const glm::dvec2& block : blocks) {
        const double off = block.x - estimate.value * block.y;
        squares += off * off;
    }
    const auto count = static_cast<double>(blocks.size());
    estimate.deviation = std::sqrt(squares * count / (count - 1)) / total.y;
    const double reach = t_quantile(count - 1) * estimate.deviation;
    estimate.lower = std::max(estimate.value - reach, 0.0);
    estimate.upper = estimate.value + reach;
    return estimate;
}

/// The denoised picture's error. A single pair of frames knows little of it, so it is averaged over
/// some pairs, in which it does not change much; over more where that is not enough.
ErrorEstimate ErrorRecord::predict(const Frame& frame, FrameErrors& errors)
{
    errors.noise = mean_of_tiles(frame.predicted, frame.extent, 0).value;
    errors.raw = mean_of_tiles(frame.predicted, frame.extent, 1).value;
    if (frame.history_reset)
        predicted_pairs_ = 0;
    const ErrorEstimate half_picture =
        mean_of_tiles(frame.predicted, frame.extent, 2, Over::kPairs);
    if (half_picture.known() && std::isfinite(half_picture.deviation)) {
        // A half picture has half the samples, so twice the noise of the whole one.
        const double whole = half_picture.value - errors.noise;
        const double square = half_picture.deviation * half_picture.deviation;
        const bool precise = 4 * predicted_square_ < predicted_ * predicted_;
        ++predicted_pairs_;
        const double weight =
            std::max(1.0 / predicted_pairs_, 1.0 / (precise ? kPairs : kMostPairs));
        predicted_ = weight < 1 ? predicted_ + weight * (whole - predicted_) : whole;
        predicted_square_ = weight < 1
            ? (1 - weight) * (1 - weight) * predicted_square_ + weight * weight * square
            : square;
    }
    if (predicted_pairs_ == 0)
        return {};
    const double reach = 1.96 * std::sqrt(predicted_square_);
    return {std::max(predicted_, errors.noise), std::max(predicted_ - reach, 0.0),
        std::max(predicted_ + reach, errors.noise), std::sqrt(predicted_square_)};
}

void ErrorRecord::measure(const Frame& frame)
{
    noise_of_one_frame_ = mean_of_tiles(frame.measured, frame.extent, 2).value * frame.mean_frames;
    if (frame.reference_frames == 0)
        return;
    measured_ = mean_of_tiles(frame.measured, frame.extent, 0);
    measured_.value = std::max(measured_.value, 0.0);
    reference_samples_ =
        static_cast<std::uint32_t>(frame.reference_frames * frame.samples_per_pixel);
}

FrameErrors ErrorRecord::add(const Frame& frame)
{
    FrameErrors errors;
    if (frame.mean_frames <= 1) {
        measured_ = {};
        reference_samples_ = 0;
        noise_of_one_frame_ = std::numeric_limits<double>::quiet_NaN();
    }
    ErrorEstimate denoised;
    if (!frame.predicted.empty())
        denoised = predict(frame, errors);
    if (!frame.measured.empty())
        measure(frame);
    // Until the mean has shown how far its frames scatter, what tells one from the picture stands
    // for it.
    if (std::isfinite(noise_of_one_frame_))
        errors.raw = noise_of_one_frame_;
    errors.measured = measured_;
    errors.reference_samples = reference_samples_;
    errors.predicted = measured_.known() ? measured_ : denoised;
    const double weight = frame.mean_weight;
    if (weight > 0) {
        const double noise = errors.raw / frame.mean_frames;
        for (double* end :
            {&errors.predicted.value, &errors.predicted.lower, &errors.predicted.upper})
            *end = weight < 1 ? of_blend(*end, noise, weight) : noise;
        errors.noise = weight < 1 ? of_blend(errors.noise, noise, weight) : noise;
    }
    errors.effective_samples = errors.predicted.value > 0
        ? errors.raw / errors.predicted.value * frame.samples_per_pixel
        : std::numeric_limits<double>::quiet_NaN();
    return errors;
}

int frames_to_forget(double alpha)
{
    return alpha >= 1 ? 1 : static_cast<int>(std::ceil(std::log(1e-3) / std::log1p(-alpha)));
}

}  // namespace farlight
