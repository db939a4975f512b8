// Controller: see the header. Wishes first, then the steps from rung to rung.
#include "server/stream/controller.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace farlight {
namespace {

/// A frame is too long above this times the budget: what is less scatter does too.
constexpr double kTooLong = 1.1;
/// One frame this much longer than the budget is enough to step down: waiting for a second one
/// would make the stutter twice as long.
constexpr double kFarTooLong = 2;
/// More than this many misses of the newest 50 frames is more than the 2 % that may be missed, even
/// where each is small.
constexpr int kMissesAllowed = 2;
constexpr std::uint64_t kNewest50 = (std::uint64_t{1} << 50U) - 1;
/// In settling, so many frames tell as much as kWait do later.
constexpr int kSettlingWait = 2;
/// A step up lasted if the rung stayed for so many waits.
constexpr int kLasting = 4;
constexpr int kLongestWait = 32 * Controller::kWait;
}  // namespace

// ---------------------------------------------------------------- wishes

void Controller::follow(const RenderSettings& wishes, Extent extent)
{
    if (wishes == wishes_ && extent == extent_ && !ladder().empty())
        return;
    const bool anew = ladder().empty() || extent != extent_ || wishes.budget_ms != wishes_.budget_ms
        || wishes.target_error != wishes_.target_error;
    const std::optional<std::size_t> rung = current();
    const Choice before = rung ? ladder()[*rung].choice : Choice();
    wishes_ = wishes;
    extent_ = extent;
    resting_samples_.reset();
    rebuilt_at_.reset();
    prices_.follow(wishes, extent);
    const auto same = std::find_if(
        ladder().begin(), ladder().end(), [&](const Rung& one) { return one.choice == before; });
    if (anew || same == ladder().end())
        return begin_anew();
    current_ = static_cast<std::size_t>(same - ladder().begin());
}

void Controller::change_scene()
{
    prices_.change_scene();
    settling_ = kSettlingFrames;
    resting_samples_.reset();
}

void Controller::begin_anew()
{
    settling_ = kSettlingFrames;
    wait_ = kWait;
    stepped_up_ = false;
    current_ = choice().best();
    begin_counting(std::nullopt);
}

RenderSettings Controller::settings(bool resting)
{
    if (!resting) {
        resting_samples_.reset();
        return steers() ? with_choice(wishes_, ladder()[current_].choice) : wishes_;
    }
    if (!resting_samples_) {
        Choice choice = choice_of(wishes_);
        while (
            budget() > 0 && choice.samples_per_pixel > 1 && prices_.slow_ms_of(choice) > budget())
            --choice.samples_per_pixel;
        resting_samples_ = choice.samples_per_pixel;
    }
    RenderSettings settings = wishes_;
    settings.samples_per_pixel = *resting_samples_;
    return settings;
}

// ---------------------------------------------------------------- steps

std::optional<std::size_t> Controller::current() const
{
    return steers() && !ladder().empty() ? std::optional(current_) : std::nullopt;
}

void Controller::drawn(const DrawnCost& frame, Time now)
{
    settling_ = std::max(settling_ - 1, 0);
    const bool first = !prices_.known();
    if (!prices_.measure(frame))
        return;
    if (first)
        rebuild(now);
    // Frames planned before a step say nothing about the rung after it.
    if (steers() && frame.choice == ladder()[current_].choice)
        decide(frame.ms(), now);
}

void Controller::decide(double ms, Time now)
{
    ++frames_;
    if (budget() > 0 && breaks_budget(ms))
        return step_down(now);
    const std::size_t wish = choice().wished(current_);
    const auto side = [this](std::size_t rung) { return (rung > current_) - (rung < current_); };
    wish_frames_ = side(wish) == 0 ? 0 : side(wish) == side(wish_) ? wish_frames_ + 1 : 1;
    wish_ = wish;
    if (wish_frames_ == 0)
        return;
    const bool waited = wish_frames_ >= wait_ && (!stepped_ || now - *stepped_ >= kBetweenSteps);
    if (waited || (settling_ > 0 && wish_frames_ >= kSettlingWait))
        step_to(wish, now);
}

/// What this frame shows; makes it known to the prices too, as far as it is sure.
bool Controller::breaks_budget(double ms)
{
    const double last_ms = std::exchange(last_ms_, ms);
    misses_ = ((misses_ << 1U) | (ms > budget() ? 1U : 0U)) & kNewest50;
    if (ms > kTooLong * budget() && last_ms > kTooLong * budget()) {
        prices_.expect_at_least(std::min(ms, last_ms));
        return true;
    }
    if (ms > kFarTooLong * budget()) {
        // One frame may be an exception: as much of it as makes it far too long is believed.
        prices_.expect_at_least(kFarTooLong * budget());
        return true;
    }
    return std::popcount(misses_) > kMissesAllowed;
}

void Controller::step_down(Time now)
{
    if (current_ == 0)
        return;
    const bool lasted = !stepped_up_ || frames_ >= kLasting * wait_;
    wait_ = lasted ? kWait : std::min(2 * wait_, kLongestWait);
    step_to(choice().dearest_within_budget(current_), now);
}

void Controller::step_to(std::size_t rung, Time now)
{
    stepped_up_ = rung > current_;
    current_ = rung;
    ++steps_;
    begin_counting(now);
}

void Controller::begin_counting(std::optional<Time> stepped)
{
    stepped_ = stepped;
    frames_ = 0;
    misses_ = 0;
    last_ms_ = 0;
    wish_frames_ = 0;
}

/// Another ladder; the rung stays, or becomes the dearest that is no dearer.
void Controller::rebuild(Time now)
{
    rebuilt_at_ = now;
    const Rung before = ladder()[current_];
    prices_.rebuild();
    std::size_t rung = 0;
    for (std::size_t i = 0; i < ladder().size(); ++i) {
        if (ladder()[i].choice == before.choice) {
            current_ = i;
            return;
        }
        if (ladder()[i].ms <= before.ms)
            rung = i;
    }
    current_ = rung;
    if (!steers())
        return;
    ++steps_;
    begin_counting(now);
}

std::optional<protocol::Frontier> Controller::news(Time now)
{
    if (!prices_.known() || !news_.due(now))
        return std::nullopt;
    // Another ladder may be a step, so that it waits like one; misses are met without it.
    const bool may_step = !stepped_ || now - *stepped_ >= kBetweenSteps;
    if (may_step && (!rebuilt_at_ || now - *rebuilt_at_ >= FrontierNews::kBetweenNews))
        rebuild(now);
    return rebuilt_at_ == now ? news_.tell(prices_, extent_, now) : std::nullopt;
}

}  // namespace farlight
