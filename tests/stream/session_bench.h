// SessionBench: plays renderer, encoder and socket around one Session, one step at a time, and
// keeps what the session says and sends.
#pragma once

#include "server/stream/session.h"

#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

namespace farlight {

struct SentFrame {
    protocol::FrameHeader header;
};

class SessionBench {
public:
    using Time = Session::Time;

    SessionBench();

    void receive(const protocol::ClientMessage& message);
    void receive_garbage(const protocol::DecodeError& error);
    /// `settings`: besides still_samples.
    void hello(protocol::Mode mode, std::uint32_t max_in_flight, int still_samples = 256,
        const std::map<std::string, nlohmann::json>& settings = {});
    void move_camera(std::uint32_t sequence);
    void acknowledge(std::uint32_t frame_id);
    void pass_time(std::chrono::milliseconds time);

    // One step each. False: there was nothing to do.
    bool renderer_takes();
    bool renderer_finishes();
    bool encoder_finishes();
    bool socket_takes();
    bool socket_finishes();
    /// All of them, until nothing moves.
    void settle();

    Session& session() { return session_; }
    /// What went out since the last call, in order, as JSON: messages as on the wire, frames as
    /// {"type": "frame", "frame_id": ...}, the end as {"type": "close", "code": ...}.
    std::vector<nlohmann::json> take_events() { return std::exchange(events_, {}); }

    Time now{std::chrono::hours(1)};
    std::uint32_t newest_camera = 0;  ///< Sequence last sent by move_camera().
    std::vector<RenderRequest> taken;  ///< By the renderer, in order.
    std::vector<SentFrame> sent;
    double frame_ms = 0;  ///< Of the renderer, at full size and 1 sample; in proportion to both.
    std::uint64_t controller_steps = 0;
    int frames_dropped = 0;
    int messages_refused = 0;

private:
    void collect();
    RenderedFrame draw(const RenderRequest& request);

    std::shared_ptr<Session::Slot> slot_;
    Session session_;
    std::deque<RenderRequest> rendering_;
    std::optional<RenderRequest> previous_;
    std::uint32_t samples_ = 0;
    std::deque<EncodeTask> encoding_;
    bool writing_ = false;
    std::vector<nlohmann::json> events_;
};

/// A camera message whose position.x is its sequence.
protocol::Camera camera_message(std::uint32_t sequence);

}  // namespace farlight
