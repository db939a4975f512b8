// How a sweep is measured: which frames, how many, with what settings.
#pragma once

#include "client/accuracy/effect_costs.h"
#include "client/accuracy/grid.h"
#include "client/accuracy/response.h"
#include "client/accuracy/times.h"

namespace farlight::client {

/// What a user asks of a sweep.
struct SweepExtent {
    GridSize grid = GridSize::kNormal;
    int seeds = 10;
    int reference_samples =
        0;  ///< 0: 128 times the most that a measured frame has, 256 in classic and normal grids.
    double degrees_per_frame = 0;  ///< The camera's turn while histories fill; 0: it rests.
};

struct Plans {
    ReferencePlan reference;
    ReferencePlan step_reference;
    ErrorPlan error;
    TimePlan time;
    ResponsePlan response;
    ResponsePlan motion;
    int motion_frames;  ///< While the lamps move.
    EffectsPlan effects;
};

Plans plans_for(const Grid& grid, const SweepExtent& extent);

/// The sweep's starting point; the same without filter; the same averaged over frames.
SweepPoint base_point(const Grid& grid);
SweepPoint raw_point(const Grid& grid);
SweepPoint averaging_point(const Grid& grid);

/// The points whose unrest and response to a change of light are looked at.
std::vector<SweepPoint> response_points(const Grid& grid);

}  // namespace farlight::client
