// Keyframes of one track, written from the first to the last.
#pragma once

#include "server/scene/animation.h"

#include <cmath>
#include <utility>

namespace farlight {

/// Times given to it must not decrease. A step among ramps lasts one ulp of time.
class TrackKeys {
public:
    explicit TrackKeys(std::vector<double> at_rest) : value_(std::move(at_rest)) { }

    /// From the value now to `value`, linearly.
    void ramp(double start, double end, const std::vector<double>& value)
    {
        if (track_.times.empty() || track_.times.back() < start)
            push(start);
        value_ = value;
        push(end);
        ramps_ = true;
    }
    void step(double time, const std::vector<double>& value)
    {
        if (!track_.times.empty() && track_.times.back() == time)
            track_.times.back() = std::nextafter(time, 0.0);
        else if (time > 0)
            push(std::nextafter(time, 0.0));
        value_ = value;
        push(time);
    }
    Track finish(Track::Target target, std::uint32_t index)
    {
        track_.target = target;
        track_.index = index;
        track_.interpolation = ramps_ ? Track::Interpolation::kLinear : Track::Interpolation::kStep;
        return std::move(track_);
    }

private:
    void push(double time)
    {
        track_.times.push_back(time);
        for (const double part : value_)
            track_.values.push_back(static_cast<float>(part));
    }

    Track track_;
    std::vector<double> value_;
    bool ramps_ = false;
};

}  // namespace farlight
