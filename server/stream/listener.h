// Listener: the accepting side. One port, one network thread, HTTP and WebSocket.
#pragma once

#include "server/stream/hub.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <stdexcept>

namespace farlight {

/// The address cannot be listened on; what() says why and what to do.
struct ListenError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Listener {
public:
    /// Listens from here on; nothing is served before run(). `renderer` must outlive the listener.
    /// Throws ListenError.
    Listener(RenderService& renderer, const StreamOptions& options);
    /// Waits for encoders and for frames being drawn.
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    /// As in "http://127.0.0.1:8080/".
    std::string url() const;
    std::uint16_t port() const;
    boost::asio::io_context& context() { return hub_.context; }

    /// Serves on this thread, the network thread, until a shut-down is complete.
    void run();
    /// Says goodbye to every client and lets run() return once they are gone, or after
    /// StreamOptions::drain. Thread-safe.
    void shut_down();

private:
    void accept();
    void admit(boost::asio::ip::tcp::socket socket);
    void watch_renderer();
    void drain();
    void stop_if_drained();

    Hub hub_;
    boost::asio::ip::tcp::acceptor acceptor_;
    boost::asio::steady_timer retry_accept_;
    boost::asio::steady_timer renderer_watch_;
    boost::asio::steady_timer drain_deadline_;
};

}  // namespace farlight
