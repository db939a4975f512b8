// FakeServer: a WebSocket server for tests that does what the test says. No OpenGL; one thread a
// connection.
#pragma once

#include "client/connection.h"
#include "protocol/codec.h"
#include "protocol/frame_header.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/websocket.hpp>
#include <functional>
#include <thread>

namespace farlight {

/// The server's end of one connection. Functions throw boost::system::system_error when the peer is
/// gone.
class FakePeer {
public:
    using Stream = boost::beast::websocket::stream<boost::asio::ip::tcp::socket>;
    explicit FakePeer(Stream& stream) : stream_(stream) { }

    /// The next message; records a test failure when it is none.
    protocol::ClientMessage read();
    void send(const protocol::ServerMessage& message) { send_text(protocol::encode(message)); }
    void send_text(const std::string& text);
    void send_binary(const std::vector<std::byte>& bytes);
    void send_frame(protocol::FrameHeader header, const std::vector<std::byte>& payload);
    void close(std::uint16_t code, const std::string& reason);
    /// Ends the TCP connection without a word.
    void drop();

private:
    Stream& stream_;
};

class FakeServer {
public:
    using Handler = std::function<void(FakePeer&)>;

    /// Runs `handler` for every connection; its exceptions end the connection.
    explicit FakeServer(
        Handler handler, std::string subprotocol = std::string(protocol::kSubprotocol));
    ~FakeServer();

    client::Url url() const { return {"127.0.0.1", std::to_string(port_), "/ws"}; }
    std::string url_text() const { return "ws://127.0.0.1:" + std::to_string(port_) + "/ws"; }

private:
    void accept();

    Handler handler_;
    std::string subprotocol_;
    boost::asio::io_context io_;
    boost::asio::ip::tcp::acceptor acceptor_;
    unsigned short port_ = 0;
    std::vector<std::jthread> connections_;  ///< Touched by the accepting thread only.
    std::jthread accepting_;  ///< Joined first, being last.
};

/// A renderer without geometry: every pixel is 1 plus noise that `none` leaves, `svgf` shrinks to a
/// tenth and `accumulate` averages. Equal seeds give equal bytes.
struct FakeRenderer {
    bool ignores_seed = false;  ///< Draws something else each time: not deterministic.
    int nan_in_frame = -1;  ///< This frame holds one NaN.
    std::uint32_t own_after = 3;  ///< Frames drawn by the general programs.
    std::string refuses_setting;  ///< This key is answered by an error.
};

/// The welcome of that renderer.
protocol::Welcome fake_welcome();

/// Serves a lockstep session until bye.
void serve_lockstep(FakePeer& peer, const FakeRenderer& renderer);

}  // namespace farlight
