// Pacing: how many frames one client may have under way, by acknowledgement.
//
// A frame is in flight from the moment the renderer is asked for it until the client says it has
// shown it. At most `window` frames are in flight, so a slow client slows its own frames and nobody
// else's, and nothing piles up in the kernel or in a proxy. No clock, no sockets: time points come
// in.
#pragma once

#include "protocol/messages.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace farlight {

class Pacing {
public:
    using Time = std::chrono::steady_clock::time_point;

    /// `window` in [1, kMaxInFlight]. Frame ids go on from `last_sent`.
    explicit Pacing(int window, std::uint32_t last_sent = 0);

    int in_flight() const { return preparing_ + static_cast<int>(unacknowledged_.size()); }
    /// One more frame may be asked of the renderer.
    bool may_start() const { return in_flight() < window_; }

    /// A frame was asked of the renderer.
    void started();
    /// A frame that was started will never be sent.
    void dropped();
    /// A frame that was started is handed to the socket. `frame_id` counts up from 1 and
    /// wraps round.
    /// `asked`: arrival of the message that asked for it, if any.
    void sent(std::uint32_t frame_id, Time now, std::optional<Time> asked);
    /// The socket took the frame's last byte: from now on only the client is to blame.
    void written(std::uint32_t frame_id, Time now);

    struct Acknowledgement {
        std::chrono::steady_clock::duration round_trip;  ///< Since the frame was sent.
        std::optional<std::chrono::steady_clock::duration> since_asked;
    };
    /// The client has shown `frame_id`, and with it all frames sent before it.
    /// Nothing, and no effect, for a frame never sent or already acknowledged.
    std::optional<Acknowledgement> acknowledge(std::uint32_t frame_id, Time now);

    /// How long the oldest frame the socket is done with has waited for its acknowledgement.
    std::chrono::steady_clock::duration oldest_wait(Time now) const;

private:
    struct Sent {
        std::uint32_t frame_id;
        Time sent;
        std::optional<Time> asked;
        std::optional<Time> written;
    };

    int window_;
    int preparing_ = 0;  ///< Asked for, not yet sent.
    std::uint32_t last_sent_;
    std::deque<Sent> unacknowledged_;  ///< In the order sent; at most window_.
};

}  // namespace farlight
