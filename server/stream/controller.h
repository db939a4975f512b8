// Controller: keeps one session's moving pictures within its budgets by choosing among rungs.
// Pure logic: no clock, no threads; frames and points in time go in, settings come out.
//
//   budget_ms > 0       the rung of least error whose frames take no longer
//   target_error > 0    the cheapest rung whose error is no larger; where errors are learnt, none
//   of
//                       a picture smaller than asked for
//   both                the budget wins
//   neither             the settings as they are
//
// It steps down at once: a stutter that lasts is felt, a little noise is not. It steps up when a
// dearer rung would have left a fifth of the budget free for 30 frames, at most once a second; a
// step up that did not last doubles that wait. Times of equal frames scatter, so that a rung fits
// if 98 % of its frames do.
//
// What it chooses among voids no history. A picture that rests is drawn with the settings as they
// are, only with fewer samples a frame where these would break the budget; as long as it rests
// nothing changes, or its mean would begin anew.
#pragma once

#include "server/stream/frontier_news.h"
#include "server/stream/rung_choice.h"

#include <chrono>
#include <cstdint>
#include <memory>

namespace farlight {

class Controller {
public:
    using Time = std::chrono::steady_clock::time_point;

    /// Frames after a new budget, size or scene in which it steps up without waiting.
    static constexpr int kSettlingFrames = 10;
    static constexpr int kWait = 30;  ///< [frames] before a step up; see also above.
    static constexpr std::chrono::seconds kBetweenSteps{1};

    /// `report`: what to choose among; without one that is learnt from frames.
    explicit Controller(std::shared_ptr<const FrontierReport> report = nullptr)
        : prices_(std::move(report))
    {
    }

    /// What the person asks for now, of a picture that is `extent` large at full resolution.
    void follow(const RenderSettings& wishes, Extent extent);
    void change_scene();
    /// A frame of a moving picture, begun at `now`; frames come in the order they were drawn in.
    void drawn(const DrawnCost& frame, Time now);

    /// The wishes as the next frame is to be drawn.
    RenderSettings settings(bool resting);
    /// The frontier, where it has not been said yet or is known better.
    std::optional<protocol::Frontier> news(Time now);
    /// Which point of the frontier last said this choice is, from 1; 0: none.
    std::uint16_t rung_of(const Choice& choice) const { return news_.rung_of(choice); }

    /// Which rung of the ladder draws moving pictures; nothing: the settings as they are.
    std::optional<std::size_t> current() const;
    const std::vector<Rung>& ladder() const { return prices_.ladder(); }
    /// How often the rung has changed while the wishes stayed.
    std::uint64_t steps() const { return steps_; }

private:
    bool steers() const { return budget() > 0 || target() > 0; }
    double budget() const { return static_cast<double>(wishes_.budget_ms); }
    double target() const { return static_cast<double>(wishes_.target_error); }
    RungChoice choice() const { return {prices_, wishes_}; }

    void begin_anew();

    void rebuild(Time now);
    void decide(double ms, Time now);
    bool breaks_budget(double ms);
    void step_down(Time now);
    void step_to(std::size_t rung, Time now);
    void begin_counting(std::optional<Time> stepped);

    RungPrices prices_;
    FrontierNews news_;
    RenderSettings wishes_;
    Extent extent_;

    std::size_t current_ = 0;
    std::uint64_t steps_ = 0;
    int settling_ = 0;  ///< Frames left of kSettlingFrames.
    std::optional<Time> stepped_;  ///< Last.
    bool stepped_up_ = false;  ///< Last.
    int wait_ = kWait;

    // Since the last step.
    int frames_ = 0;
    std::uint64_t misses_ = 0;  ///< Of the newest 50 frames, a bit each, the newest lowest.
    double last_ms_ = 0;
    std::size_t wish_ = 0;  ///< Another rung that has been wished for,
    int wish_frames_ = 0;  ///< for so many frames.

    std::optional<int> resting_samples_;  ///< Of the picture that rests now.
    std::optional<Time> rebuilt_at_;  ///< The ladder, since the wishes last changed.
};

}  // namespace farlight
