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
    int samples = 0;

    /// relMSE against the truth: mean(variance / (mean^2 + 0.01)).
    double own_relmse() const;
};

/// Draws the batches, or reads those that are in `folder` already. Throws MetricError when a value
/// is not finite. `folder` empty: nothing is kept.
ReferencePicture draw_reference(
    Rig& rig, const ReferencePlan& plan, const std::filesystem::path& folder, Progress& progress);

/// Removes the batches that draw_reference() keeps in `folder`, and nothing else.
void remove_batches(const std::filesystem::path& folder);

/// Mean and variance of the mean over batches of equal weight, at least 2.
ReferencePicture reference_of(const std::vector<Picture>& batches);

}  // namespace farlight::client
