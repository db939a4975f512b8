// SlotSource: what the renderer sees of a connection. Lives on the render thread and hands
// everything over to the network thread.
#pragma once

#include "server/stream/session.h"

#include <boost/asio/io_context.hpp>
#include <deque>
#include <functional>

namespace farlight {

class SlotSource : public FrameSource {
public:
    /// Called on the network thread, in the order in which things happened.
    struct Events {
        std::function<void()> taken;  ///< The renderer has taken the slot's request.
        std::function<void(RenderedFrame frame, Session::Time begun)> drawn;
    };

    SlotSource(std::shared_ptr<Session::Slot> slot, boost::asio::io_context::executor_type network,
        Events events);

    std::optional<RenderRequest> next_request() override;
    void frame_done(RenderedFrame frame) override;

private:
    std::shared_ptr<Session::Slot> slot_;
    boost::asio::io_context::executor_type network_;
    Events events_;
    std::deque<Session::Time> begun_;  ///< When each frame being drawn was asked for.
};

}  // namespace farlight
