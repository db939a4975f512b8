// FrontierNews: what a client is told of a session's ladder, and when.
#pragma once

#include "protocol/server_messages.h"
#include "server/stream/rung_prices.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace farlight {

class FrontierNews {
public:
    using Time = std::chrono::steady_clock::time_point;

    static constexpr std::chrono::seconds kBetweenNews{1};

    /// Whether something may be said again.
    bool due(Time now) const { return !said_at_ || now - *said_at_ >= kBetweenNews; }
    /// The ladder, unless it is much as it was said last; for pictures that are `extent` large at
    /// full resolution.
    std::optional<protocol::Frontier> tell(const RungPrices& prices, Extent extent, Time now);
    /// Which point of the frontier last said this choice is, from 1; 0: none.
    std::uint16_t rung_of(const Choice& choice) const;

private:
    std::vector<Rung> said_;
    std::optional<Time> said_at_;
};

}  // namespace farlight
