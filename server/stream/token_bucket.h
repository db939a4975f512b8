// TokenBucket: how fast a client's messages are read. No clock of its own.
#pragma once

#include <algorithm>
#include <chrono>

namespace farlight {

class TokenBucket {
public:
    using Time = std::chrono::steady_clock::time_point;
    using Duration = std::chrono::steady_clock::duration;

    /// Holds at most `burst` tokens, refilled at `per_second`; full at the start.
    TokenBucket(double burst, double per_second, Time now)
        : burst_(burst)
        , per_second_(per_second)
        , tokens_(burst)
        , last_(now)
    {
    }

    /// Takes one token, on credit if none is left. Returns how long to pause to be out of debt.
    Duration take(Time now)
    {
        const std::chrono::duration<double> passed = now - last_;
        tokens_ = std::min(burst_, tokens_ + passed.count() * per_second_) - 1;
        last_ = now;
        return std::chrono::duration_cast<Duration>(
            std::chrono::duration<double>(std::max(0.0, -tokens_) / per_second_));
    }

private:
    double burst_;
    double per_second_;
    double tokens_;
    Time last_;
};

}  // namespace farlight
