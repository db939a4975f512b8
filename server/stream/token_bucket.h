// TokenBucket: how many messages a client may send. No clock of its own.
#pragma once

#include <algorithm>
#include <chrono>

namespace farlight {

class TokenBucket {
public:
    using Time = std::chrono::steady_clock::time_point;

    /// Holds at most `burst` tokens, refilled at `per_second`; full at the start.
    TokenBucket(double burst, double per_second)
        : burst_(burst)
        , per_second_(per_second)
        , tokens_(burst)
    {
    }

    /// Takes one token. False: none is left at `now`.
    bool take(Time now)
    {
        if (last_ != Time{}) {
            const double seconds = std::chrono::duration<double>(now - last_).count();
            tokens_ = std::min(burst_, tokens_ + std::max(0.0, seconds) * per_second_);
        }
        last_ = now;
        if (tokens_ < 1)
            return false;
        tokens_ -= 1;
        return true;
    }

private:
    double burst_;
    double per_second_;
    double tokens_;
    Time last_{};
};

}  // namespace farlight
