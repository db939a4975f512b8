// Session: one client's state, from its hello to its bye. No sockets, no threads, no clock:
// messages, drawn frames and time points go in; effects come out and are carried out by whoever
// owns it.
//
// Everything is called on the network thread. The only thing shared is the slot that the render
// thread takes its next request from.
#pragma once

#include "protocol/codec.h"
#include "server/stream/controller.h"
#include "server/stream/draw_plan.h"
#include "server/stream/encoder.h"
#include "server/stream/latest.h"
#include "server/stream/pacing.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace farlight {

/// WebSocket close codes this server uses, as in PROTOCOL.md section 7.
enum class CloseCode : std::uint16_t {
    kNormal = 1000,
    kGoingAway = 1001,
    kBinaryRefused = 1003,
    kPolicy = 1008,
    kTooBig = 1009,
    kRendererFailed = 1011,
    kStalled = 4008,
};

constexpr int kMaxRefusedMessages = 100;

struct SessionDeadlines {
    std::chrono::milliseconds hello{5000};
    std::chrono::milliseconds acknowledgement{10000};
};

/// What the owner of a session is to do, in order.
namespace effects {
struct Say {
    protocol::ServerMessage message;
};
/// Encode, then Session::encoded().
struct Encode {
    EncodeTask task;
};
/// A request lies in the slot.
struct WakeRenderer { };
struct Close {
    CloseCode code;
    std::string reason;
};
struct Acknowledged {
    Pacing::Acknowledgement times;
};
struct FrameDropped {
    std::string_view why;
};
struct MessageRefused {
    std::string problem;
};
/// The controller has chosen another rung so many times.
struct Stepped {
    std::uint64_t times;
};
/// Change the scene, then Session::scene_changed() of all sessions or edit_refused() of this one.
struct Edit {
    protocol::Edit edit;
};
}  // namespace effects

using SessionEffect = std::variant<effects::Say, effects::Encode, effects::WakeRenderer,
    effects::Close, effects::Acknowledged, effects::FrameDropped, effects::MessageRefused,
    effects::Stepped, effects::Edit>;

/// A frame for the socket: the two parts are written one after the other as one message.
struct OutgoingFrame {
    std::vector<std::byte> header;
    std::vector<std::uint8_t> payload;
};

/// What every session of a server starts from.
struct SessionDefaults {
    protocol::Welcome welcome;
    RenderRequest request;  ///< Scene camera, default settings and size.
    int max_dimension = 0;
    SessionDeadlines deadlines;
    std::shared_ptr<const RendererDescription> description;
    std::shared_ptr<const FrontierReport>
        frontier;  ///< What controllers choose among; may be null.
};

class Session {
public:
    using Time = std::chrono::steady_clock::time_point;
    using Slot = Latest<RenderRequest>;

    Session(std::shared_ptr<const SessionDefaults> defaults, std::string name,
        std::shared_ptr<Slot> slot, Time now);

    // What happens to a session.
    void receive(const protocol::ClientMessage& message, Time now);
    void receive_garbage(const protocol::DecodeError& error);
    void renderer_took_request();
    void drawn(RenderedFrame frame, Time begun);
    void encoded(EncodedFrame frame);
    void frame_written(Time now);
    /// The scene is another: `defaults` are those of it. `edit`: this session's edit that did it.
    void scene_changed(std::shared_ptr<const SessionDefaults> defaults,
        std::optional<protocol::Edit> edit, Time now);
    void edit_refused(const std::string& why, const std::string& pointer);
    void tick(Time now);
    void renderer_failed(const std::string& why);
    void shut_down(const std::string& reason, std::uint32_t reconnect_ms);
    /// Only the first close counts; afterwards nothing has an effect.
    void close(CloseCode code, std::string reason);

    /// The next frame to write, when the socket is free for one.
    std::optional<OutgoingFrame> take_frame(Time now);
    /// Effects since the last call.
    std::vector<SessionEffect> take_effects();

    int frames_in_flight() const { return pacing_ ? pacing_->in_flight() : 0; }
    bool closed() const { return closed_; }

private:
    struct ReadyFrame {
        EncodedFrame frame;
        std::optional<Time> asked;
    };

    void on(const protocol::Hello& hello, Time now);
    void on(const protocol::Camera& camera, Time now);
    void on(const protocol::Set& set, Time now);
    void on(const protocol::Resize& resize, Time now);
    void on(const protocol::SetFormat& set_format, Time now);
    void on(const protocol::Ack& ack, Time now);
    void on(const protocol::Ping& ping, Time now);
    void on(const protocol::ClientBye& bye, Time now);
    void on(const protocol::Edit& edit, Time now);
    void on(const protocol::Inspect& inspect, Time now);

    void plan_drawing();
    Draw steered(Draw draw);
    void steer_by(const RenderedFrame& frame, const Draw& draw, Time begun);
    void say_frontier(Time now);
    bool may_start() const;
    void drop_frame(std::string_view why);
    bool try_setting(RenderSettings& settings, const std::string& key, const nlohmann::json& value);
    std::optional<Extent> checked_extent(std::uint32_t width, std::uint32_t height);
    void refuse(protocol::Error error);
    void say_state();

    std::shared_ptr<const SessionDefaults> defaults_;
    std::string name_;
    std::shared_ptr<Slot> slot_;
    Time opened_;

    std::optional<DrawPlan> plan_;  ///< Since hello.
    std::optional<Pacing> pacing_;  ///< Since hello.
    std::optional<Controller> controller_;  ///< Since hello, if interactive.
    std::deque<Draw> drawing_;  ///< Asked of the renderer, in order; the last may lie in the slot.
    std::deque<std::optional<Time>> encoding_;  ///< When each was asked for, in order.
    std::deque<ReadyFrame> ready_;  ///< Wait for the socket; interactive: at most one.
    std::uint32_t last_frame_id_ = 0;
    protocol::Inspection last_frame_;  ///< What the last frame was drawn with.
    int refused_messages_ = 0;
    bool closed_ = false;
    std::vector<SessionEffect> effects_;
};

}  // namespace farlight
