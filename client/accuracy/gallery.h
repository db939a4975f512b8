// Pictures of some points of the frontier for people: the frame, the reference, and where they
// differ.
#pragma once

#include "client/accuracy/errors.h"

namespace farlight::client {

/// Draws each point's frames once more and gives, as REPORT.md describes it, data URIs:
/// "reference", "scales" and for each point "frame", "absolute", "flip", "bias" and "deviation".
nlohmann::json draw_gallery(Rig& rig, const std::vector<SweepPoint>& points, const ErrorPlan& plan,
    const ReferencePicture& reference);

/// At most `count` of the positions 0 to `size` - 1, both ends among them, evenly spread.
std::vector<std::size_t> spread(std::size_t size, std::size_t count);

}  // namespace farlight::client
