// RungErrors: how large the error of each choice is, from the estimates that frames carry.
//
// Of smaller pictures these are no measurements but an order, as add() says.
//
// Only what has been drawn lately is known; the rest is scaled from it as strength_of() has it: the
// part of the error that is noise goes with 1 / (samples * 2^iterations), all of it with 1 /
// pixels, and between two known choices the logarithm of the error goes linearly with that of
// strength. A choice of more strength is always given less error: where two estimates contradict
// that (the view has changed between them), the older gives way.
#pragma once

#include "server/stream/choice.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace farlight {

/// relMSE, with its 95 % interval where it was estimated, at full size, and not scaled.
struct RungError {
    double value = 0;
    double lower = std::numeric_limits<double>::quiet_NaN();
    double upper = std::numeric_limits<double>::quiet_NaN();
    /// The part of `value` that samples and filter lessen; not finite: all of it.
    double noise = std::numeric_limits<double>::quiet_NaN();
};

class RungErrors {
public:
    /// A choice not drawn for this many frames is unknown again: the camera has gone elsewhere.
    static constexpr std::uint64_t kMemory = 300;

    /// A frame was drawn so. Estimates that are not finite and positive are left out. They are of
    /// the pixels drawn: what enlarging a smaller picture adds, at edges most of it, is not known.
    /// To keep the order of strength_of(), estimate / resolution_scale^2 stands for that error.
    void add(const Choice& choice, RungError estimate);
    void forget() { known_.clear(); }

    /// By choice, strictly falling with strength; nothing while nothing is known.
    std::vector<std::optional<RungError>> errors_of(const std::vector<Choice>& choices) const;

private:
    struct Known {
        Choice choice;
        RungError error;  ///< Mean of the newest frames.
        std::uint64_t frame = 0;  ///< Last.
    };

    std::vector<Known> consistent() const;

    std::vector<Known> known_;
    std::uint64_t frames_ = 0;
};

}  // namespace farlight
