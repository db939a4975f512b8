// See the header.
#include "server/render/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace farlight {
namespace {

constexpr int kBlockTiles = 8;
constexpr std::size_t kFewestBlocks = 9;  ///< Fewer would leave the spread itself uncertain.
constexpr std::size_t kFewestForAnInterval = 5;
/// Pairs of frames that a prediction is averaged over, and at most where it is not precise.
constexpr int kPairs = 8;
constexpr int kMostPairs = 64;

constexpr double kNormal = 1.959964;  ///< Two-sided 95 % quantile of the normal distribution.

/// Two-sided 95 % quantile of Student's t, from 4 degrees of freedom on: the first terms of its
/// expansion about the normal one. Source: Abramowitz and Stegun 1964, 26.7.5.
double t_quantile(double degrees_of_freedom)
{
    constexpr double kCube = kNormal * kNormal * kNormal;
    return kNormal + (kCube + kNormal) / (4 * degrees_of_freedom)
        + (5 * kCube * kNormal * kNormal + 16 * kCube + 3 * kNormal)
        / (96 * degrees_of_freedom * degrees_of_freedom);
}

std::size_t index_of(int x, int y, int across)
{
    return static_cast<std::size_t>(x)
        + static_cast<std::size_t>(y) * static_cast<std::size_t>(across);
}

/// Sums of `component` and what they are over, of blocks of `side` x `side` tiles. Blocks in which
/// nothing counts are left out.
std::vector<glm::dvec2> block_sums(
    std::span<const glm::vec4> sums, Extent tiles, int component, int side)
{
    const int across = (tiles.width + side - 1) / side;
    const int down = (tiles.height + side - 1) / side;
    std::vector<glm::dvec2> blocks(
        static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x) {
            const glm::vec4& tile = sums[index_of(x, y, tiles.width)];
            blocks[index_of(x / side, y / side, across)] += glm::dvec2(tile[component], tile.w);
        }
    std::erase_if(blocks, [](const glm::dvec2& block) { return !(block.y > 0); });
    return blocks;
}

/// Errors of a blend of denoised picture and mean, the latter with the share `weight`. They are
/// taken for independent: the newest samples are in both, but the filter has spread each of them
/// over many pixels.
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

ErrorEstimate mean_of_tiles(std::span<const glm::vec4> sums, Extent extent, int component)
{
    const Extent tiles = tiles_of(extent);
    int side = kBlockTiles;
    std::vector<glm::dvec2> blocks = block_sums(sums, tiles, component, side);
    while (blocks.size() < kFewestBlocks && side > 1) {
        side /= 2;
        blocks = block_sums(sums, tiles, component, side);
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
    if (blocks.size() < kFewestForAnInterval)
        return estimate;
    const double reach = t_quantile(count - 1) * estimate.deviation;
    estimate.lower = std::max(estimate.value - reach, 0.0);
    estimate.upper = estimate.value + reach;
    return estimate;
}

/// What a frame says of the denoised picture's error: the first of a pair its noise, the second all
/// of it. A single pair of frames knows little, so it is averaged over some pairs, in which it does
/// not change much; over more where that is not enough.
void ErrorRecord::predict(const Frame& frame)
{
    const ErrorEstimate product = mean_of_tiles(frame.predicted, frame.extent, 2);
    if (!frame.second_of_pair) {
        noise_ = mean_of_tiles(frame.predicted, frame.extent, 0).value;
        raw_ = mean_of_tiles(frame.predicted, frame.extent, 1).value;
        if (!std::isfinite(noise_))  // nothing counts: what was known is of another picture
            predicted_pairs_ = 0;
        return;
    }
    if (!product.known() || !std::isfinite(product.deviation) || !std::isfinite(noise_))
        return;
    // A half picture has half the samples, so twice the noise of the whole one.
    const double whole = product.value - noise_;
    const double square = product.deviation * product.deviation;
    const bool precise = 4 * predicted_square_ < predicted_ * predicted_;
    ++predicted_pairs_;
    const double weight = std::max(1.0 / predicted_pairs_, 1.0 / (precise ? kPairs : kMostPairs));
    predicted_ = weight < 1 ? predicted_ + weight * (whole - predicted_) : whole;
    predicted_square_ = weight < 1
        ? (1 - weight) * (1 - weight) * predicted_square_ + weight * weight * square
        : square;
}

ErrorEstimate ErrorRecord::prediction() const
{
    if (predicted_pairs_ == 0)
        return {};
    const double reach = kNormal * std::sqrt(predicted_square_);
    return {std::max(predicted_, noise_), std::max(predicted_ - reach, 0.0),
        std::max(predicted_ + reach, noise_), std::sqrt(predicted_square_)};
}

void ErrorRecord::measure(const Frame& frame)
{
    noise_of_one_frame_ = mean_of_tiles(frame.measured, frame.extent, 2);
    for (double* end :
        {&noise_of_one_frame_.value, &noise_of_one_frame_.lower, &noise_of_one_frame_.upper})
        *end *= frame.mean_frames;
    if (frame.reference_frames == 0)
        return;
    measured_ = mean_of_tiles(frame.measured, frame.extent, 0);
    measured_.value = std::max(measured_.value, 0.0);
    measured_.upper = std::max(measured_.upper, measured_.value);
    reference_samples_ =
        static_cast<std::uint32_t>(frame.reference_frames * frame.samples_per_pixel);
}

FrameErrors ErrorRecord::add(const Frame& frame)
{
    FrameErrors errors;
    if (frame.starts_anew) {
        predicted_pairs_ = 0;
        noise_ = raw_ = std::numeric_limits<double>::quiet_NaN();
    }
    if (frame.starts_anew || frame.mean_frames <= 1) {
        measured_ = {};
        reference_samples_ = 0;
    }
    if (frame.mean_frames <= 1)
        noise_of_one_frame_ = {};
    if (!frame.predicted.empty())
        predict(frame);
    const ErrorEstimate denoised = frame.denoised ? prediction() : ErrorEstimate{};
    if (frame.denoised) {
        errors.noise = noise_;
        errors.raw = raw_;
    }
    if (!frame.measured.empty())
        measure(frame);
    // Until the mean has shown how far its frames scatter, what tells one from the picture stands
    // for it.
    ErrorEstimate of_one = noise_of_one_frame_;
    if (!of_one.known())
        of_one = {errors.raw, errors.raw, errors.raw};
    errors.raw = of_one.value;
    errors.measured = measured_;
    errors.reference_samples = reference_samples_;
    errors.predicted = measured_.known() ? measured_ : denoised;
    const double weight = frame.mean_weight;
    if (weight > 0) {
        const auto blended = [&](double of_denoised, double of_one_frame) {
            const double of_mean = of_one_frame / frame.mean_frames;
            return weight < 1 ? of_blend(of_denoised, of_mean, weight) : of_mean;
        };
        errors.predicted = {blended(errors.predicted.value, of_one.value),
            blended(errors.predicted.lower, of_one.lower),
            blended(errors.predicted.upper, of_one.upper)};
        errors.noise = blended(errors.noise, of_one.value);
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
