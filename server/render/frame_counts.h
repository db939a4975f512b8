// FrameCounts: where a view stands in its sequence of frames. They go on counting for years:
// those that number samples wrap round, those that say how many there are stay at the most.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace farlight {

/// What became of the picture since the frame before.
struct FrameChange {
    bool has_history = false;  ///< Else everything begins anew.
    bool same_samples = false;  ///< Samples of this frame and the last may be averaged.
    bool averages = false;  ///< The running mean is wanted.
};

class FrameCounts {
public:
    FrameCounts() = default;
    /// As after `frames` frames of `samples_per_pixel` each, all alike and averaged.
    FrameCounts(std::uint64_t frames, int samples_per_pixel)
        : frame_index_(static_cast<std::uint32_t>(frames - 1))
        , first_sample_(
              static_cast<std::uint32_t>(frames * static_cast<std::uint64_t>(samples_per_pixel)))
        , still_(static_cast<int>(std::min<std::uint64_t>(frames, kMost)))
        , mean_(still_)
    {
    }

    /// Counts stop here, so that products and floats of them are still numbers.
    static constexpr int kMost = std::numeric_limits<int>::max();

    /// A frame begins.
    void begin(const FrameChange& change)
    {
        frame_index_ = change.has_history ? frame_index_ + 1 : 0;
        if (!change.has_history)
            first_sample_ = 0;
        const bool same = change.has_history && change.same_samples;
        still_ = same ? one_more(still_) : 1;
        mean_ = !change.averages ? 0 : same ? one_more(mean_) : 1;
    }
    /// It has drawn these.
    void end(int samples_per_pixel)
    {
        first_sample_ += static_cast<std::uint32_t>(samples_per_pixel);
    }

    /// Frames since the cut, modulo 2^32.
    std::uint32_t frame_index() const { return frame_index_; }
    /// Number of the frame's first sample in a pixel, modulo 2^32: none is drawn twice when
    /// samples_per_pixel changes.
    std::uint32_t first_sample() const { return first_sample_; }
    /// Frames since the samples last changed, with this one.
    int still() const { return still_; }
    /// Frames in the running mean, with this one; 0: it does not run.
    int mean() const { return mean_; }

    /// A pixel, in the mean, or drawn since they last changed; at the most 2^32 - 1.
    std::uint32_t samples(int samples_per_pixel) const
    {
        const std::uint64_t count = static_cast<std::uint64_t>(mean_ > 0 ? mean_ : still_)
            * static_cast<std::uint64_t>(samples_per_pixel);
        return static_cast<std::uint32_t>(
            std::min<std::uint64_t>(count, std::numeric_limits<std::uint32_t>::max()));
    }

private:
    static int one_more(int count) { return count < kMost ? count + 1 : kMost; }

    std::uint32_t frame_index_ = 0;
    std::uint32_t first_sample_ = 0;
    int still_ = 0;
    int mean_ = 0;
};

}  // namespace farlight
