// The size a server starts with when nobody asked for one: as large as still moves.
#pragma once

#include "server/render/settings.h"
#include "server/render/view.h"

namespace farlight {

/// Measures a few small frames and gives the largest 16:9 size that draws in under 80 ms, which
/// leaves a fifth of 10 frames a second to encoding and sending; 1280x720 at most, 128x72 at least.
/// GL thread.
Extent start_extent(
    const SharedScene& scene, const CameraPose& camera, const RenderSettings& settings);

/// The ladder's largest size for a device that needs `ms_per_pixel`.
Extent largest_extent_within(double ms_per_pixel, double budget_ms);

}  // namespace farlight
