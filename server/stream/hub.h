// Hub: what all connections of one listener share. Used on the network thread, except where said.
#pragma once

#include "server/stream/metrics.h"
#include "server/stream/render_service.h"
#include "server/stream/session.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/thread_pool.hpp>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace farlight {

class Connection;

struct StreamOptions {
    std::string bind = "127.0.0.1";
    std::uint16_t port = 8080;  ///< 0: any free one.
    std::vector<std::string> allowed_origins;  ///< Besides the server's own; "*" allows all.
    int max_clients = 64;
    bool edits = true;  ///< Clients may change the scene.
    std::shared_ptr<const FrontierReport> frontier;  ///< For their budgets; null: it is learnt.

    // Deadlines; tests shorten them.
    SessionDeadlines session;
    std::chrono::milliseconds http_request{5000};  ///< From connecting to the end of the header.
    std::chrono::milliseconds write_progress{10000};  ///< The socket takes at least a byte in this.
    std::chrono::milliseconds silence{30000};  ///< No pong for this long: the peer is gone.
    std::chrono::milliseconds close_handshake{2000};
    std::chrono::milliseconds drain{5000};  ///< Shutting down takes no longer.
};

struct Hub {
    Hub(RenderService& service, StreamOptions stream_options);

    RenderService& renderer;  ///< Thread-safe.
    const StreamOptions options;
    std::shared_ptr<const SessionDefaults> session_defaults;  ///< Of the scene being drawn.
    Metrics metrics;  ///< Thread-safe.
    std::set<Connection*> connections;
    int http_connections = 0;
    std::uint64_t sessions_opened = 0;
    bool draining = false;
    std::shared_ptr<FrameSource> snapshot;  ///< Being drawn: one at a time.
    std::function<void()> on_connection_gone;
    int edits_waiting = 0;

    // Last, so that they go first: `context` holds connections, whose strands are those of
    // `workers`.
    boost::asio::thread_pool detacher{1};  ///< Waits for frames being drawn. Thread-safe.
    boost::asio::thread_pool workers;  ///< Encode. Thread-safe.
    boost::asio::io_context context;  ///< The network thread's. Posting to it is thread-safe.
    boost::asio::thread_pool editor{1};  ///< Edits, one after the other; posts to `context`.

    /// Empty, or why no client can be served now.
    std::string not_ready() const;
    int frames_in_flight() const;
    /// Changes the scene, then tells all sessions, or `author` why not.
    void edit(std::weak_ptr<Connection> author, protocol::Edit edit);
    void tell_of_new_scene(const std::weak_ptr<Connection>& author, const protocol::Edit& edit);
    /// Detaches without holding up network or encoders: a frame may be being drawn.
    void detach_later(std::shared_ptr<FrameSource> source);
};

}  // namespace farlight
