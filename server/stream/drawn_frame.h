// What a client gets to know of a drawn frame: how it is to be encoded, its header, and what
// `inspect` tells of it.
#pragma once

#include "protocol/server_messages.h"
#include "server/stream/draw_plan.h"
#include "server/stream/encoder.h"
#include "server/stream/rung_prices.h"

#include <chrono>

namespace farlight {

/// `begun`: when the renderer took the request. `final`: it is the last of a resting picture, and
/// so lossless.
EncodeTask task_for(RenderedFrame&& frame, const Draw& draw,
    std::chrono::steady_clock::time_point begun, bool final);

/// What a controller learns from it.
DrawnCost cost_of(const RenderedFrame& frame, const Draw& draw);

/// A resting picture needs no more samples: it has those that were asked for, or, after 8 frames at
/// rest, an error whose 95 % interval ends below what was asked for.
bool is_final(const RenderedFrame& frame, const Draw& draw);

/// What the frame was drawn with; the scene's part is left empty.
protocol::Inspection inspection_of(const RenderedFrame& frame);

}  // namespace farlight
