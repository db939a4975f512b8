// See the header.
#include "server/render/error_schedule.h"

#include "server/render/error_estimate.h"

#include <algorithm>

namespace farlight {
namespace {

/// While histories grow the error changes from pair to pair; later every other pair knows enough.
constexpr std::uint32_t kFramesThatAllPredict = 16;
/// Frames between two looks at the noise of a mean without a filter.
constexpr int kPlainStretch = 8;
/// The first older mean is taken after at most so many frames, so that a picture with mirrors,
/// whose stretch is 135 frames, is measured before it is final after 256 samples.
constexpr int kFirstMean = 64;

/// Frames between two measurements of a resting picture: those within which the denoiser forgets,
/// a mirror's light last (svgf/temporal.comp).
int stretch_of(const FramePlan& plan, bool specular)
{
    if (!is_denoised(plan))
        return kPlainStretch;
    const RenderSettings& s = plan.settings;
    const double alpha = (specular ? 0.25 : 1) * static_cast<double>(s.svgf_alpha);
    return frames_to_forget(std::max(alpha, 1.0 / s.history_max));
}

}  // namespace

ErrorLooks ErrorSchedule::next(const FramePlan& plan, bool new_filter, bool specular)
{
    if (new_filter || plan.frame_index == 0) {
        filter_began_ = plan.frame_index;
        pair_begun_ = false;
    }
    if (new_filter || plan.mean_frames <= 1)
        reference_frames_ = 0;
    ErrorLooks looks;
    predict(plan, looks);
    measure(plan, specular, looks);
    return looks;
}

/// A pair's first frame has an even index, as the chessboard of its halves asks
/// (svgf/noise.glsl).
void ErrorSchedule::predict(const FramePlan& plan, ErrorLooks& looks)
{
    const std::uint32_t index = plan.frame_index;
    const bool estimates = plan.settings.error_estimate && is_denoised(plan);
    const bool due = index - filter_began_ < kFramesThatAllPredict || index % 4 < 2;
    looks.second_of_pair = estimates && pair_begun_;
    looks.predicts = estimates && (pair_begun_ || (index % 2 == 0 && due));
    pair_begun_ = looks.predicts && !pair_begun_;
}

/// At the end of every stretch of frames that the denoiser forgets within, its picture is compared
/// with the mean as it was when the stretch began. What comes before the first stretch may be
/// shorter.
void ErrorSchedule::measure(const FramePlan& plan, bool specular, ErrorLooks& looks)
{
    if (!plan.settings.error_estimate || !is_averaged(plan)) {
        reference_frames_ = 0;
        return;
    }
    const int stretch = stretch_of(plan, specular);
    const int since_first = plan.mean_frames - std::min(stretch, kFirstMean);
    const bool at_end = since_first >= 0 && since_first % stretch == 0;
    looks.measures = at_end && plan.mean_frames > 1;
    if (!is_denoised(plan))
        return;
    looks.reference = at_end ? Reference::kTake : Reference::kKeep;
    looks.measured_against = looks.measures && reference_frames_ > 1 ? reference_frames_ : 0;
    if (at_end)
        reference_frames_ = plan.mean_frames;
}

}  // namespace farlight
