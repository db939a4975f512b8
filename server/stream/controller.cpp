// Controller: see the header. Wishes first, then how a rung is chosen, then what is said of it.
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
/// Share of the budget that a rung has to leave free before it is stepped up to, and of the target
/// error before it is stepped down to.
constexpr double kLeaves = 0.8;
/// In settling, so many frames tell as much as kWait do later.
constexpr int kSettlingWait = 2;
/// One step up draws at most so many times the samples: what is farther off is known too badly.
constexpr double kFarthest = 8;
/// A step up lasted if the rung stayed for so many waits.
constexpr int kLasting = 4;
constexpr int kLongestWait = 32 * Controller::kWait;
/// The frontier is said again when times or errors have changed by these factors.
constexpr double kNewMs = 1.1;
constexpr double kNewError = 1.25;

constexpr const char* kReportUnused =
    "every point of the server's report differs from this session's settings in more than "
    "resolution_scale, samples_per_pixel and atrous_iterations";

bool differs(double a, double b, double factor)
{
    const bool close = a <= factor * b && b <= factor * a;
    return !close && !(std::isnan(a) && std::isnan(b));
}

bool differs(const Rung& a, const Rung& b)
{
    if (a.choice != b.choice || differs(a.ms, b.ms, kNewMs)
        || a.error.has_value() != b.error.has_value())
        return true;
    return a.error
        && (differs(a.error->value, b.error->value, kNewError)
            || std::isnan(a.error->lower) != std::isnan(b.error->lower));
}

protocol::FrontierPoint point_of(const Rung& rung)
{
    protocol::FrontierPoint point{rung.label, {}, rung.ms, {}, {}, {}};
    point.settings = {{"resolution_scale", rung.choice.resolution_scale},
        {"samples_per_pixel", rung.choice.samples_per_pixel},
        {"atrous_iterations", rung.choice.atrous_iterations}};
    if (!rung.error)
        return point;
    point.error = rung.error->value;
    if (std::isfinite(rung.error->lower) && std::isfinite(rung.error->upper)) {
        point.lower = rung.error->lower;
        point.upper = rung.error->upper;
    }
    return point;
}

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
    current_ = best_rung();
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

// ---------------------------------------------------------------- choosing

std::optional<std::size_t> Controller::current() const
{
    return steers() && !ladder().empty() ? std::optional(current_) : std::nullopt;
}

/// The dearest rung before `end` that fits, or the cheapest of all.
std::size_t Controller::dearest_within_budget(std::size_t end) const
{
    std::size_t rung = end;
    while (rung > 0 && prices_.slow_ms_of(ladder()[rung - 1].choice) > budget())
        --rung;
    return rung > 0 ? rung - 1 : 0;
}

/// What was learnt of a picture smaller than asked for leaves out what enlarging it adds.
bool Controller::reaches(const Rung& rung, double error) const
{
    const bool told = prices_.source() == protocol::FrontierSource::kReport
        || rung.choice.resolution_scale >= wishes_.resolution_scale;
    return told && rung.error && rung.error->value <= error;
}

/// The dearest rung if none has so small an error.
std::size_t Controller::cheapest_within(double error) const
{
    const auto found = std::find_if(
        ladder().begin(), ladder().end(), [&](const Rung& rung) { return reaches(rung, error); });
    return found == ladder().end() ? last_rung()
                                   : static_cast<std::size_t>(found - ladder().begin());
}

/// The rung that is most like the settings as they are.
std::size_t Controller::own_rung() const
{
    std::size_t rung = 0;
    for (std::size_t i = 0; i < ladder().size(); ++i)
        if (strength_of(ladder()[i].choice) <= strength_of(choice_of(wishes_)))
            rung = i;
    return rung;
}

/// Before times are known: the rung of a quarter of the pixels tells of dearer and cheaper ones
/// alike, and a device far slower than the budget is through with it four times as soon.
std::size_t Controller::first_rung() const
{
    const auto found = std::find_if(ladder().begin(), ladder().end(), [&](const Rung& rung) {
        return rung.choice.resolution_scale >= wishes_.resolution_scale / 2
            && rung.choice.atrous_iterations == wishes_.atrous_iterations;
    });
    return found == ladder().end() ? 0 : static_cast<std::size_t>(found - ladder().begin());
}

/// By what is known now, whatever the current one.
std::size_t Controller::best_rung() const
{
    const bool errors_known = ladder().front().error.has_value();
    if (budget() > 0 && !prices_.known())
        return first_rung();
    const std::size_t fits = budget() > 0 ? dearest_within_budget(ladder().size()) : last_rung();
    if (target() > 0)
        return std::min(fits, errors_known ? cheapest_within(target()) : own_rung());
    return fits;
}

/// What to step to if it is still wished for after a wait.
std::size_t Controller::wished_rung() const
{
    std::size_t fits = current_;
    const double reach = kFarthest * strength_of(ladder()[current_].choice);
    for (std::size_t i = current_ + 1; i < ladder().size(); ++i)
        if (strength_of(ladder()[i].choice) > reach)
            break;
        else if (budget() == 0
            || (prices_.ms_of(ladder()[i].choice) < kLeaves * budget()
                && prices_.slow_ms_of(ladder()[i].choice) <= budget()))
            fits = i;
    if (target() == 0)
        return fits;
    if (!ladder()[current_].error)
        return budget() > 0 ? fits : current_;
    if (!reaches(ladder()[current_], target()))
        return std::min(fits, std::max(cheapest_within(target()), current_));
    return std::min(cheapest_within(kLeaves * target()), current_);
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
    const std::size_t wish = wished_rung();
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
    step_to(dearest_within_budget(current_), now);
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

// ---------------------------------------------------------------- telling

std::optional<protocol::Frontier> Controller::news(Time now)
{
    if (!prices_.known() || (said_at_ && now - *said_at_ < kBetweenNews))
        return std::nullopt;
    // Another ladder may be a step, so that it waits like one; misses are met without it.
    const bool may_step = !stepped_ || now - *stepped_ >= kBetweenSteps;
    if (may_step && (!rebuilt_at_ || now - *rebuilt_at_ >= kBetweenNews))
        rebuild(now);
    if (rebuilt_at_ != now)
        return std::nullopt;
    const bool same = std::equal(said_.begin(), said_.end(), ladder().begin(), ladder().end(),
        [](const Rung& a, const Rung& b) { return !differs(a, b); });
    if (same)
        return std::nullopt;
    said_ = ladder();
    said_at_ = now;
    protocol::Frontier frontier{prices_.source(), {}, {}};
    if (prices_.report_unused())
        frontier.reason = kReportUnused;
    for (const Rung& rung : ladder())
        frontier.points.push_back(point_of(rung));
    return frontier;
}

std::uint16_t Controller::rung_of(const Choice& choice) const
{
    const auto said = std::find_if(
        said_.begin(), said_.end(), [&](const Rung& rung) { return rung.choice == choice; });
    return said == said_.end() ? 0 : static_cast<std::uint16_t>(said - said_.begin() + 1);
}

}  // namespace farlight
