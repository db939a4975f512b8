// Session: the way of a frame, from what is asked of the renderer to what goes out.
#include "server/stream/drawn_frame.h"
#include "server/stream/session.h"

#include <cassert>

namespace farlight {
namespace {

/// Frames of one client under way may hold this many bytes; one frame may always be under way.
constexpr std::int64_t kMostBytesInFlight = 256LL << 20U;

}  // namespace

bool Session::may_start() const
{
    const Extent extent = plan_->wishes().extent;
    const std::int64_t frame_bytes = static_cast<std::int64_t>(extent.width) * extent.height
        * static_cast<std::int64_t>(bytes_per_pixel(plan_->wishes().format));
    return pacing_->may_start()
        && (pacing_->in_flight() == 0
            || (pacing_->in_flight() + 1) * frame_bytes <= kMostBytesInFlight)
        && (plan_->mode() == protocol::Mode::kLockstep || ready_.empty());
}

void Session::plan_drawing()
{
    if (!plan_ || closed_)
        return;
    if (controller_)
        controller_->follow(plan_->wishes().settings, plan_->wishes().extent);
    if (slot_->waiting()) {
        if (const std::optional<Draw> wished = plan_->newer_than(drawing_.back())) {
            const Draw newer = steered(*wished);
            if (slot_->replace(newer.request)) {
                plan_->plan_instead(newer);
                drawing_.back() = newer;
            }
        }
    }
    while (!slot_->waiting() && may_start()) {
        const std::optional<Draw> wished = plan_->next();
        if (!wished)
            return;
        const Draw draw = steered(*wished);
        pacing_->started();
        drawing_.push_back(draw);
        slot_->put(draw.request);
        effects_.push_back(effects::WakeRenderer{});
    }
}

/// The same with what the controller has chosen.
Draw Session::steered(Draw draw)
{
    if (!controller_)
        return draw;
    draw.request.settings = controller_->settings(draw.request.refine);
    draw.by_rung = !draw.request.refine && controller_->current();
    return draw;
}

/// Lets the controller learn from a frame.
void Session::steer_by(const RenderedFrame& frame, const Draw& draw, Time begun)
{
    if (!controller_ || draw.request.refine || draw.session_epoch != plan_->session_epoch())
        return;
    const std::uint64_t steps = controller_->steps();
    controller_->drawn(cost_of(frame, draw), begun);
    say_frontier(begun);
    if (controller_->steps() != steps)
        effects_.push_back(effects::Stepped{controller_->steps() - steps});
}

void Session::say_frontier(Time now)
{
    if (std::optional<protocol::Frontier> frontier = controller_->news(now))
        effects_.push_back(effects::Say{std::move(*frontier)});
}

void Session::renderer_took_request()
{
    plan_drawing();
}

void Session::drawn(RenderedFrame frame, Time begun)
{
    assert(!drawing_.empty());
    const Draw draw = drawing_.front();
    drawing_.pop_front();
    if (closed_)
        return;
    if (!frame.error.empty())
        return renderer_failed(frame.error);
    plan_->scene_moves(frame.moves);
    last_frame_ = inspection_of(frame);
    steer_by(frame, draw, begun);
    if (plan_->repeats_final(draw)) {
        drop_frame("repeats_final");
        return plan_drawing();
    }
    if (draw.request.refine && is_final(frame, draw) && plan_->is_current(draw)) {
        plan_->settle(draw);
        if (slot_->take()) {  // Planned before anybody knew that this one would be final.
            drawing_.pop_back();
            pacing_->dropped();
        }
    }
    EncodeTask task = task_for(std::move(frame), draw, begun, plan_->repeats_final(draw));
    if (draw.by_rung)
        task.header.rung = controller_->rung_of(choice_of(draw.request.settings));
    effects_.push_back(effects::Encode{std::move(task)});
    encoding_.push_back(draw.asked);
    plan_drawing();
}

void Session::encoded(EncodedFrame frame)
{
    assert(!encoding_.empty());
    const std::optional<Time> asked = encoding_.front();
    encoding_.pop_front();
    if (closed_)
        return;
    if (!frame.error.empty())
        return renderer_failed(frame.error);
    if (plan_->mode() == protocol::Mode::kInteractive && !ready_.empty()) {
        ready_.pop_front();
        drop_frame("overtaken");
    }
    ready_.push_back({std::move(frame), asked});
}

std::optional<OutgoingFrame> Session::take_frame(Time now)
{
    if (ready_.empty() || closed_)
        return std::nullopt;
    ReadyFrame ready = std::move(ready_.front());
    ready_.pop_front();
    ready.frame.header.frame_id = ++last_frame_id_;
    pacing_->sent(last_frame_id_, now, ready.asked);
    plan_drawing();
    return OutgoingFrame{encode_frame_header(ready.frame.header), std::move(ready.frame.payload)};
}

void Session::frame_written(Time now)
{
    if (pacing_)
        pacing_->written(last_frame_id_, now);
}

void Session::drop_frame(std::string_view why)
{
    pacing_->dropped();
    effects_.push_back(effects::FrameDropped{why});
}

}  // namespace farlight
