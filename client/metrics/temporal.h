// Metrics of sequences: unrest at rest, how long a change takes to show, what the old picture
// leaves.
#pragma once

#include "client/metrics/metrics.h"

namespace farlight::client {

/// Takes frames one by one and keeps five numbers a pixel. Camera and lights at rest, warmed up,
/// and 64 frames or more make figures that can be compared. Where something moves on purpose, each
/// frame's `truth` R takes that out: L - R stands for L wherever frames are told apart.
class FlickerMeter {
public:
    /// Linear RGB, all frames of one size, with a truth or without. Throws MetricError when a value
    /// is not finite.
    void add(std::span<const float> frame, std::span<const float> truth = {});

    int frames() const { return frames_; }
    /// Mean over the pixels that count of std_t(L) / (mean_t(L) + 0.01), with the deviation that
    /// divides by one less than the frames. Throws MetricError for fewer than two frames.
    double flicker(Mask mask = {}) const;
    /// Mean of |L_t - L_(t-1)| over pixels and pairs of frames; SVGF's measure (Schied et al. 2017,
    /// section 5). Throws likewise.
    double successive_difference(Mask mask = {}) const;

private:
    void expect_pairs(Mask mask) const;

    int frames_ = 0;
    std::vector<double> level_;  ///< Mean of L.
    std::vector<double> mean_;  ///< Of L - R.
    std::vector<double> squares_;  ///< Sum of squared differences from the mean (Welford 1962).
    std::vector<double> steps_;  ///< Sum of |L_t - L_(t-1)|.
    std::vector<double> last_;
};

/// Frames after a step change until the error is below 2 times what it settles at, strictly: 0 if
/// the first frame's is. `errors` are those of the frame that first shows the change and all after
/// it, against the reference of the new state; the last one is what they settle at, and where that
/// is 0 an error of 0 is there. Throws MetricError without errors.
int lag_frames(std::span<const double> errors);

/// Residual energy: error `frames_after` the step over that of the step itself, for step responses.
double residual(std::span<const double> errors, std::size_t frames_after);

/// Pixels whose surface was hidden behind a nearer one in the frame before, by the buffers that the
/// views `depth` and `motion` show: view depth, at most 0 where nothing is, and previous minus
/// current position [px] and depth; three values a pixel. What came in from beyond the border
/// leaves no old picture behind and is not counted.
std::vector<std::uint8_t> newly_revealed(std::span<const float> depth,
    std::span<const float> motion, std::span<const float> depth_before, ImageSize size);

/// Largest |x - r| / (r + 0.01) of the pixels that `revealed` counts; throws MetricError when there
/// is none.
double ghost_residue(std::span<const float> test, std::span<const float> reference, Mask revealed);

}  // namespace farlight::client
