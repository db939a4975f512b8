// Rungs by budget, by error, and before either is known.
#include "server/stream/rung_choice.h"

#include <algorithm>

namespace farlight {
namespace {

/// Share of the budget that a rung has to leave free before it is stepped up to, and of the target
/// error before it is stepped down to.
constexpr double kLeaves = 0.8;
/// One step up draws at most so many times the samples: what is farther off is known too badly.
constexpr double kFarthest = 8;

}  // namespace

/// The dearest rung before `end` that fits, or the cheapest of all.
std::size_t RungChoice::dearest_within_budget(std::size_t end) const
{
    std::size_t rung = end;
    while (rung > 0 && prices_.slow_ms_of(ladder_[rung - 1].choice) > budget())
        --rung;
    return rung > 0 ? rung - 1 : 0;
}

/// What was learnt of a picture smaller than asked for leaves out what enlarging it adds.
bool RungChoice::reaches(const Rung& rung, double error) const
{
    const bool told = prices_.source() == protocol::FrontierSource::kReport
        || rung.choice.resolution_scale >= wishes_.resolution_scale;
    return told && rung.error && rung.error->value <= error;
}

/// The dearest rung if none has so small an error.
std::size_t RungChoice::cheapest_within(double error) const
{
    const auto found = std::find_if(
        ladder_.begin(), ladder_.end(), [&](const Rung& rung) { return reaches(rung, error); });
    return found == ladder_.end() ? last_rung() : static_cast<std::size_t>(found - ladder_.begin());
}

/// The rung that is most like the settings as they are.
std::size_t RungChoice::own_rung() const
{
    std::size_t rung = 0;
    for (std::size_t i = 0; i < ladder_.size(); ++i)
        if (strength_of(ladder_[i].choice) <= strength_of(choice_of(wishes_)))
            rung = i;
    return rung;
}

/// Before times are known: the rung of a quarter of the pixels tells of dearer and cheaper ones
/// alike, and a device far slower than the budget is through with it four times as soon.
std::size_t RungChoice::first_rung() const
{
    const auto found = std::find_if(ladder_.begin(), ladder_.end(), [&](const Rung& rung) {
        return rung.choice.resolution_scale >= wishes_.resolution_scale / 2
            && rung.choice.atrous_iterations == wishes_.atrous_iterations;
    });
    return found == ladder_.end() ? 0 : static_cast<std::size_t>(found - ladder_.begin());
}

/// By what is known now, whatever the current one.
std::size_t RungChoice::best() const
{
    const bool errors_known = ladder_.front().error.has_value();
    if (budget() > 0 && !prices_.known())
        return first_rung();
    const std::size_t fits = budget() > 0 ? dearest_within_budget(ladder_.size()) : last_rung();
    if (target() > 0)
        return std::min(fits, errors_known ? cheapest_within(target()) : own_rung());
    return fits;
}

/// What to step to if it is still wished for after a wait.
std::size_t RungChoice::wished(std::size_t current) const
{
    std::size_t fits = current;
    const double reach = kFarthest * strength_of(ladder_[current].choice);
    for (std::size_t i = current + 1; i < ladder_.size(); ++i)
        if (strength_of(ladder_[i].choice) > reach)
            break;
        else if (budget() == 0
            || (prices_.ms_of(ladder_[i].choice) < kLeaves * budget()
                && prices_.slow_ms_of(ladder_[i].choice) <= budget()))
            fits = i;
    if (target() == 0)
        return fits;
    if (!ladder_[current].error)
        return budget() > 0 ? fits : current;
    if (!reaches(ladder_[current], target()))
        return std::min(fits, std::max(cheapest_within(target()), current));
    return std::min(cheapest_within(kLeaves * target()), current);
}

}  // namespace farlight
