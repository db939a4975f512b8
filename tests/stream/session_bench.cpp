// SessionBench: see the header.
#include "tests/stream/session_bench.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

std::shared_ptr<const SessionDefaults> bench_defaults()
{
    auto defaults = std::make_shared<SessionDefaults>();
    defaults->request.extent = {64, 36};
    defaults->max_dimension = 4096;
    defaults->description = std::make_shared<RendererDescription>();
    return defaults;
}

nlohmann::json frame_event(const protocol::FrameHeader& header)
{
    namespace flags = protocol::frame_flags;
    return {{"type", "frame"}, {"frame_id", header.frame_id},
        {"camera_sequence", header.camera_sequence}, {"session_epoch", header.session_epoch},
        {"format", protocol::name_of(header.format)}, {"still", header.has(flags::kStill)},
        {"lossless", header.has(flags::kLossless)}, {"converged", header.has(flags::kConverged)},
        {"accumulated_samples", header.accumulated_samples}, {"rung", header.rung},
        {"samples_per_pixel", header.samples_per_pixel}};
}

}  // namespace

SessionBench::SessionBench()
    : slot_(std::make_shared<Session::Slot>())
    , session_(bench_defaults(), "bench", slot_, now)
{
}

void SessionBench::receive(const protocol::ClientMessage& message)
{
    session_.receive(message, now);
    collect();
}

void SessionBench::receive_garbage(const protocol::DecodeError& error)
{
    session_.receive_garbage(error);
    collect();
}

void SessionBench::hello(protocol::Mode mode, std::uint32_t max_in_flight, int still_samples,
    const std::map<std::string, nlohmann::json>& settings)
{
    protocol::Hello hello;
    hello.client = "bench";
    hello.mode = mode;
    hello.max_in_flight = max_in_flight;
    hello.settings = settings;
    hello.settings["still_samples"] = still_samples;
    receive(hello);
}

void SessionBench::move_camera(std::uint32_t sequence)
{
    newest_camera = sequence;
    receive(camera_message(sequence));
}

void SessionBench::acknowledge(std::uint32_t frame_id)
{
    receive(protocol::Ack{frame_id, std::nullopt, std::nullopt});
}

void SessionBench::pass_time(std::chrono::milliseconds time)
{
    now += time;
    session_.tick(now);
    collect();
}

bool SessionBench::renderer_takes()
{
    const std::optional<RenderRequest> request = slot_->take();
    if (!request)
        return false;
    taken.push_back(*request);
    rendering_.push_back(*request);
    session_.renderer_took_request();
    collect();
    return true;
}

bool SessionBench::renderer_finishes()
{
    if (rendering_.empty())
        return false;
    const RenderRequest request = rendering_.front();
    rendering_.pop_front();
    session_.drawn(draw(request), now);
    collect();
    return true;
}

RenderedFrame SessionBench::draw(const RenderRequest& request)
{
    const bool same = previous_ && previous_->camera == request.camera
        && previous_->settings == request.settings && previous_->extent == request.extent;
    samples_ = same ? samples_ + 1 : 1;
    previous_ = request;
    RenderedFrame frame;
    const auto scale = static_cast<double>(request.settings.resolution_scale);
    frame.trace_ms = frame_ms * scale * scale * request.settings.samples_per_pixel;
    frame.accumulated_samples = samples_;
    frame.converged = samples_ >= static_cast<std::uint32_t>(request.settings.still_samples);
    return frame;
}

bool SessionBench::encoder_finishes()
{
    if (encoding_.empty())
        return false;
    EncodedFrame frame{encoding_.front().header, {}, {}};
    encoding_.pop_front();
    session_.encoded(std::move(frame));
    collect();
    return true;
}

bool SessionBench::socket_takes()
{
    if (writing_)
        return false;
    const std::optional<OutgoingFrame> frame = session_.take_frame(now);
    if (!frame)
        return false;
    const auto view = protocol::decode_frame(frame->header);
    const auto& header = std::get<protocol::FrameView>(view).header;
    sent.push_back({header});
    events_.push_back(frame_event(header));
    writing_ = true;
    collect();
    return true;
}

bool SessionBench::socket_finishes()
{
    if (!std::exchange(writing_, false))
        return false;
    session_.frame_written(now);
    collect();
    return true;
}

void SessionBench::settle()
{
    // What is furthest on its way first: nothing is overtaken by itself.
    while (socket_finishes() || socket_takes() || encoder_finishes() || renderer_finishes()
        || renderer_takes()) { }
}

void SessionBench::collect()
{
    for (SessionEffect& effect : session_.take_effects()) {
        if (auto* say = std::get_if<effects::Say>(&effect))
            events_.push_back(nlohmann::json::parse(protocol::encode(say->message)));
        else if (auto* encode = std::get_if<effects::Encode>(&effect))
            encoding_.push_back(std::move(encode->task));
        else if (auto* close = std::get_if<effects::Close>(&effect))
            events_.push_back({{"type", "close"}, {"code", static_cast<int>(close->code)}});
        else if (const auto* stepped = std::get_if<effects::Stepped>(&effect))
            controller_steps += stepped->times;
        else if (std::holds_alternative<effects::FrameDropped>(effect))
            ++frames_dropped;
        else if (std::holds_alternative<effects::MessageRefused>(effect))
            ++messages_refused;
    }
}

protocol::Camera camera_message(std::uint32_t sequence)
{
    protocol::Camera camera;
    camera.sequence = sequence;
    camera.pose.position = {static_cast<double>(sequence), 0, 5};
    return camera;
}

}  // namespace farlight
