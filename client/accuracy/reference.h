// The truth that errors are measured against: many samples, in independent batches whose spread
// tells how far the mean of them may be off.
#pragma once

#include "client/accuracy/rig.h"
#include "client/metrics/metrics.h"

#include <filesystem>

namespace farlight::client {

/// Seeds of references are from here on, those of measured frames are below.
constexpr std::uint32_t kFirstReferenceSeed = 0x5EED;

struct ReferencePlan {
    int samples = 4096;  ///< A pixel, in all batches together; at least.
    int batches = 16;
    Settings settings;  ///< What differs from the server's own.

    double work(const protocol::Size& size) const;  ///< For the progress bar.
};

struct ReferencePicture {
    ImageSize size;
    std::vector<float> mean;  ///< Linear RGB.
    std::vector<float> variance;  ///< Of each value of the mean.
    /// Pixels that show a surface, or light that is left to chance (air, a lens): an even sky and
    /// black borders are right in every frame and would dilute its error. Empty: all count.
    std::vector<std::uint8_t> counts = {};
    int samples = 0;

    /// relMSE against the truth: mean(variance / (mean^2 + 0.01)) over the pixels that count.
    double own_relmse() const;
    double counted_share() const;
};

/// Draws the batches, or reads those that are in `folder` already. Throws MetricError when a value
/// is not finite. `folder` empty: nothing is kept.
ReferencePicture draw_reference(
    Rig& rig, const ReferencePlan& plan, const std::filesystem::path& folder, Progress& progress);

/// Removes the batches that draw_reference() keeps in `folder`, and nothing else.
void remove_batches(const std::filesystem::path& folder);

/// Mean and variance of the mean over batches of equal weight, at least 2. `depth`: of the view of
/// that name, at most 0 where no surface is; empty: all pixels count, as they do where none would.
ReferencePicture reference_of(
    const std::vector<Picture>& batches, std::span<const float> depth = {});

}  // namespace farlight::client
