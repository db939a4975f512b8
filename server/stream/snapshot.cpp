// Snapshot: see the header.
#include "server/stream/snapshot.h"

#include "server/stream/draw_plan.h"

#include <utility>

namespace farlight {

Snapshot::Snapshot(const RenderRequest& request, std::function<void(RenderedFrame)> done)
    : request_(request)
    , done_(std::move(done))
{
}

std::optional<RenderRequest> Snapshot::next_request()
{
    if (asked_ == kSnapshotFrames)
        return std::nullopt;
    RenderRequest request = request_;
    request.refine = asked_ >= kFramesUntilRest;
    ++asked_;
    return request;
}

void Snapshot::frame_done(RenderedFrame frame)
{
    ++drawn_;
    if (!done_ || (frame.error.empty() && !frame.converged && drawn_ < kSnapshotFrames))
        return;
    asked_ = kSnapshotFrames;
    std::exchange(done_, nullptr)(std::move(frame));
}

}  // namespace farlight
