// Which frames of a view tell what of their errors: not all need to, and some must wait for others.
#pragma once

#include "server/render/frame.h"

namespace farlight {

/// Frames come in order, from a cut on.
class ErrorSchedule {
public:
    /// `new_filter`: this frame's picture is made otherwise than the last one's. `specular`: the
    /// scene shows specular light. The plan is complete but for its looks.
    ErrorLooks next(const FramePlan& plan, bool new_filter, bool specular);

private:
    void predict(const FramePlan& plan, ErrorLooks& looks);
    void measure(const FramePlan& plan, bool specular, ErrorLooks& looks);

    std::uint32_t filter_began_ = 0;  ///< At this frame.
    bool pair_begun_ = false;  ///< By the last frame.
    int reference_frames_ = 0;  ///< In the older mean to measure against; 0: there is none.
};

}  // namespace farlight
