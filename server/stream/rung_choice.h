// RungChoice: which rung of a ladder serves a session's wishes best. Pure; made anew whenever it is
// needed.
#pragma once

#include "server/stream/rung_prices.h"

#include <cstddef>

namespace farlight {

class RungChoice {
public:
    /// Both must outlive it; the ladder holds at least one rung.
    RungChoice(const RungPrices& prices, const RenderSettings& wishes)
        : prices_(prices)
        , ladder_(prices.ladder())
        , wishes_(wishes)
    {
    }

    std::size_t best() const;
    std::size_t wished(std::size_t current) const;
    std::size_t dearest_within_budget(std::size_t end) const;

private:
    double budget() const { return static_cast<double>(wishes_.budget_ms); }
    double target() const { return static_cast<double>(wishes_.target_error); }
    std::size_t last_rung() const { return ladder_.size() - 1; }

    bool reaches(const Rung& rung, double error) const;
    std::size_t cheapest_within(double error) const;
    std::size_t own_rung() const;
    std::size_t first_rung() const;

    const RungPrices& prices_;
    const std::vector<Rung>& ladder_;
    const RenderSettings& wishes_;
};

}  // namespace farlight
