// Snapshot: one picture of the scene from its own camera, for GET /snapshot.png.
#pragma once

#include "server/render/renderer.h"

#include <functional>

namespace farlight {

/// Frames accumulated for one snapshot.
constexpr int kSnapshotFrames = 32;

/// Draws `request` kSnapshotFrames times, refining, and hands the last frame on.
class Snapshot : public FrameSource {
public:
    /// `done` is called once, on the render thread, with the last frame or the first that failed.
    Snapshot(const RenderRequest& request, std::function<void(RenderedFrame)> done);

    std::optional<RenderRequest> next_request() override;
    void frame_done(RenderedFrame frame) override;

private:
    RenderRequest request_;
    std::function<void(RenderedFrame)> done_;
    int asked_ = 0;  ///< Render thread only, as is `drawn_`.
    int drawn_ = 0;
};

}  // namespace farlight
