// Session: a connection after hello, and lockstep driving: one camera, one frame.
#pragma once

#include "client/connection.h"
#include "client/picture.h"

#include <chrono>
#include <map>

namespace farlight::client {

/// The server refused something, broke off, or sent what it should not.
struct SessionError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The server refused a message or a value in hello: what was asked for is wrong.
struct RefusedError : SessionError {
    explicit RefusedError(const protocol::Error& said)
        : SessionError("the server refuses: " + said.message)
        , error(said)
    {
    }
    protocol::Error error;
};

/// Thrown by receive functions when the server stays silent this long; a first frame may compile
/// shaders.
constexpr std::chrono::minutes kPatience{5};

/// Whether the frame was drawn with programs that hold nothing but what is called for.
bool drawn_with_own_programs(const protocol::Inspection& inspection);

class Session {
public:
    /// Connects, says hello and waits for welcome. Throws ConnectionError, RefusedError,
    /// SessionError.
    Session(const Url& url, const protocol::Hello& hello);

    const protocol::Welcome& welcome() const { return welcome_; }
    Connection& connection() { return connection_; }

    /// Sends a camera; returns its sequence.
    std::uint32_t send_camera(const protocol::Pose& pose, bool cut = false);
    /// The next frame; other messages are taken note of. Throws RefusedError, SessionError.
    Frame next_frame();
    void acknowledge(const Frame& frame);

    /// Lockstep: sends a camera and returns its frame, acknowledged.
    Frame draw(const protocol::Pose& pose, bool cut = false);
    /// Changes a setting and waits for the server's word. Throws RefusedError.
    void set(const std::string& key, const nlohmann::json& value);
    /// Changes the size of frames and waits for the server's word. Throws RefusedError.
    void resize(const protocol::Size& size);
    /// Changes the scene and waits until frames show it. Throws RefusedError.
    protocol::SceneChanged edit(const nlohmann::json& merge_patch, bool reset = false);
    /// What the scene calls for, and what the last frame was drawn with.
    protocol::Inspection inspect();
    /// Lockstep, with the setting `effects` at auto: draws until a frame came from the scene's own
    /// programs, or `patience` has passed; what the last frame was drawn with.
    protocol::Inspection await_own_programs(
        const protocol::Pose& pose, std::chrono::milliseconds patience);
    void close() { connection_.close(); }

private:
    /// The next message or frame; errors, closes and garbage become exceptions.
    std::variant<protocol::ServerMessage, Frame> next();

    /// The next message that `accept`s; others are taken note of.
    template <typename Message, typename Accept> Message wait_for(const Accept& accept);

    Connection connection_;
    protocol::Welcome welcome_;
    std::uint32_t sequence_ = 0;
    std::uint32_t last_edit_ = 0;
};

}  // namespace farlight::client
