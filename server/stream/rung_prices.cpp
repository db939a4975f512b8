// The model's prices, corrected by what the newest frames took.
#include "server/stream/rung_prices.h"

#include "server/render/frame_limits.h"

#include <algorithm>
#include <cmath>

namespace farlight {
namespace {

/// The first frame of a size or scene also allocates and compiles.
constexpr int kFirstFrames = 1;
/// Standard deviation of equal frames' times, relative: before any is known, and at least.
constexpr double kFirstScatter = 0.1;
constexpr double kLeastScatter = 0.03;
/// Of a choice that is new, so many frames are fitted; a level is known after as many.
constexpr int kFramesOfFit = 3;
/// Weights of a new frame in the average time, and in how times scatter.
constexpr double kTimeWeight = 0.25;
constexpr double kScatterWeight = 0.05;
/// Two frames that differ by more standard deviations than this, relative, had different loads.
constexpr double kLargestScatter = 0.3;
/// 98 % of a normal distribution lie below so many standard deviations.
constexpr double k98Percent = 2.054;
/// Longer frames are no rungs, unless a budget asks for them: nothing moves any more [ms].
constexpr double kLongestFrame = 1000;
/// A rung that is there goes only when it takes so much longer, lest it come and go.
constexpr double kStays = 1.25;

double megapixels_of(Extent extent)
{
    return 1e-6 * static_cast<double>(extent.width) * static_cast<double>(extent.height);
}

}  // namespace

RungPrices::RungPrices(std::shared_ptr<const FrontierReport> report)
    : report_(std::move(report))
    , variance_(kFirstScatter * kFirstScatter)
    , frames_to_skip_(kFirstFrames)
{
}

void RungPrices::follow(const RenderSettings& wishes, Extent extent)
{
    if (extent != extent_)
        frames_to_skip_ = kFirstFrames;
    wishes_ = wishes;
    extent_ = extent;
    rebuild();
}

void RungPrices::change_scene()
{
    frames_of_choice_ = 0;
    level_known_ = false;
    errors_.forget();
    frames_to_skip_ = kFirstFrames;
    refresh(ladder_);
}

bool RungPrices::measure(const DrawnCost& frame)
{
    if (!(frame.ms() > 0))
        return false;
    if (frames_to_skip_ > 0) {
        --frames_to_skip_;
        return false;
    }
    const bool same = frames_of_choice_ > 0 && frame.choice == lately_;
    if (same)
        note_scatter(frame.ms());
    frames_of_choice_ = same ? frames_of_choice_ + 1 : 1;
    lately_ = frame.choice;
    last_ms_ = frame.ms();
    learn(frame);
    errors_.add(frame.choice, frame.error);
    refresh(ladder_);
    return true;
}

/// The first frames of a choice tell how it differs from others, the later ones and those of
/// another scene how loaded the device is.
void RungPrices::learn(const DrawnCost& frame)
{
    const double megapixels = megapixels_of(extent_);
    const double residual = residual_of(frame.choice);
    const double trace_ms = frame.trace_ms / residual;
    const double denoise_ms = frame.denoise_ms / residual;
    if (!costs_.knows() || (level_known_ && frames_of_choice_ <= kFramesOfFit)) {
        costs_.add_frame(megapixels, frame.choice, trace_ms, denoise_ms);
        level_known_ = true;
        return;
    }
    costs_.follow_load(megapixels, frame.choice, trace_ms, denoise_ms,
        std::max(1.0 / frames_of_choice_, kTimeWeight));
    level_known_ = level_known_ || frames_of_choice_ >= kFramesOfFit;
}

/// Half the mean square of differences is the variance, whatever the average drifts to.
void RungPrices::note_scatter(double ms)
{
    const double off = std::abs(ms - last_ms_) / (ms + last_ms_) * std::sqrt(2.0);
    const double counted = std::min(off, kLargestScatter);
    variance_ += kScatterWeight * (counted * counted - variance_);
    variance_ = std::max(variance_, kLeastScatter * kLeastScatter);
}

void RungPrices::expect_at_least(double ms)
{
    const double expected = ms_of(lately_);
    if (expected > 0 && ms > expected)
        costs_.scale(ms / expected);
    refresh(ladder_);
}

bool RungPrices::report_unused() const
{
    return report_ != nullptr && source_ == protocol::FrontierSource::kLearnt;
}

double RungPrices::residual_of(const Choice& choice) const
{
    const auto reported = std::find_if(residuals_.begin(), residuals_.end(),
        [&](const auto& residual) { return residual.first == choice; });
    return reported == residuals_.end() ? 1 : reported->second;
}

double RungPrices::ms_of(const Choice& choice) const
{
    return residual_of(choice) * costs_.ms(megapixels_of(extent_), choice);
}

double RungPrices::slow_ms_of(const Choice& choice) const
{
    return ms_of(choice) * (1 + k98Percent * std::sqrt(variance_));
}

/// Of each pixel drawn at this scale; a frame of more is refused as too much work.
double RungPrices::most_samples(double scale) const
{
    return kMostSegments / (1e6 * megapixels_of(extent_) * scale * scale * wishes_.max_depth);
}

/// Also makes the model what the report makes it, while it is nothing. What would be
/// refused is left out.
std::vector<Rung> RungPrices::reported_rungs()
{
    residuals_.clear();
    if (report_ == nullptr)
        return {};
    std::vector<Rung> rungs = rungs_of(*report_, wishes_);
    const double megapixels = megapixels_of(report_->size);
    CostModel model;
    for (const Rung& rung : rungs)
        model.add_total(megapixels, rung.choice, rung.ms);
    for (const Rung& rung : rungs)
        residuals_.emplace_back(rung.choice, rung.ms / model.ms(megapixels, rung.choice));
    if (!costs_.knows())
        costs_ = model;
    std::erase_if(rungs, [&](const Rung& rung) {
        return rung.choice.samples_per_pixel
            > most_samples(static_cast<double>(rung.choice.resolution_scale));
    });
    return rungs;
}

std::vector<Rung> RungPrices::candidates() const
{
    const double most = most_samples(static_cast<double>(wishes_.resolution_scale));
    std::vector<Rung> rungs;
    for (const Choice& choice : candidate_choices(wishes_, static_cast<int>(std::min(most, 1e6))))
        rungs.push_back({choice, label_of(choice, choice_of(wishes_)), 0, std::nullopt});
    return rungs;
}

void RungPrices::refresh(std::vector<Rung>& rungs) const
{
    std::vector<Choice> choices;
    for (Rung& rung : rungs) {
        rung.ms = ms_of(rung.choice);
        choices.push_back(rung.choice);
    }
    if (source_ == protocol::FrontierSource::kReport)
        return;
    const auto errors = errors_.errors_of(choices);
    for (std::size_t i = 0; i < rungs.size(); ++i)
        rungs[i].error = errors[i];
}

void RungPrices::rebuild()
{
    std::vector<Rung> rungs = reported_rungs();
    source_ = rungs.empty() ? protocol::FrontierSource::kLearnt : protocol::FrontierSource::kReport;
    if (rungs.empty())
        rungs = candidates();
    refresh(rungs);
    if (known()) {
        rungs = frontier_of(std::move(rungs));
        const double longest = std::max(kLongestFrame, static_cast<double>(wishes_.budget_ms));
        const auto too_long = [&](const Rung& rung) {
            const bool stands = std::any_of(ladder_.begin(), ladder_.end(),
                [&](const Rung& old) { return old.ms > 0 && old.choice == rung.choice; });
            return rung.ms > longest * (stands ? kStays : 1);
        };
        rungs.erase(std::find_if(rungs.begin() + 1, rungs.end(), too_long), rungs.end());
    }
    ladder_ = std::move(rungs);
}

}  // namespace farlight
