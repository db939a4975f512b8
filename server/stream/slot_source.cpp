// From the render thread to the network thread.
#include "server/stream/slot_source.h"

#include <boost/asio/post.hpp>

namespace farlight {

SlotSource::SlotSource(std::shared_ptr<Session::Slot> slot,
    boost::asio::io_context::executor_type network, Events events)
    : slot_(std::move(slot))
    , network_(std::move(network))
    , events_(std::move(events))
{
}

std::optional<RenderRequest> SlotSource::next_request()
{
    std::optional<RenderRequest> request = slot_->take();
    if (!request)
        return std::nullopt;
    begun_.push_back(std::chrono::steady_clock::now());
    boost::asio::post(network_, events_.taken);
    return request;
}

void SlotSource::frame_done(RenderedFrame frame)
{
    const Session::Time begun = begun_.front();
    begun_.pop_front();
    boost::asio::post(network_, [drawn = events_.drawn, frame = std::move(frame), begun]() mutable {
        drawn(std::move(frame), begun);
    });
}

}  // namespace farlight
