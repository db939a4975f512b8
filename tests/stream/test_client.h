// TestClient: a WebSocket client for the listener's tests, and a one-shot HTTP request. Every wait
// ends after kPatience at the latest, so that a hanging server fails a test instead of stopping it.
#pragma once

#include "protocol/codec.h"
#include "protocol/frame_header.h"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <map>
#include <string>
#include <variant>

namespace farlight {

constexpr std::chrono::seconds kPatience{20};

using Headers = std::map<std::string, std::string>;
using HttpReply = boost::beast::http::response<boost::beast::http::string_body>;

struct ReceivedFrame {
    protocol::FrameHeader header;
    std::vector<std::byte> payload;
};
struct Closed {
    int code = 1006;  ///< 1006: without a close frame.
};
using Received = std::variant<protocol::ServerMessage, ReceivedFrame, Closed>;

class TestClient {
public:
    /// Connects and upgrades; http_status() is 101 if that went well.
    explicit TestClient(std::uint16_t port, const Headers& headers = {},
        const std::string& subprotocol = "farlight.v1");

    int http_status() const { return http_status_; }
    const HttpReply& upgrade_reply() const { return upgrade_reply_; }

    void say(const protocol::ClientMessage& message);
    void say_text(const std::string& text, bool binary = false);
    /// Writes bytes below the WebSocket layer.
    void write_raw(const std::string& bytes);

    Received receive();
    /// The next `Message`, skipping everything else. Fails the test if the connection ends before
    /// it.
    template <typename Message> Message next();
    ReceivedFrame next_frame();
    /// Reads until the connection ends; the close code.
    int wait_for_close();

    /// hello; returns the welcome.
    protocol::Welcome hello(const protocol::Hello& hello);
    void acknowledge(std::uint32_t frame_id);

private:
    template <typename Start> void run(Start start);

    boost::asio::io_context context_;
    boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
    boost::beast::flat_buffer incoming_;
    boost::beast::error_code error_;
    HttpReply upgrade_reply_;
    int http_status_ = 0;
};

/// Greetings for the two modes; the interactive one has its final picture after 16 samples.
protocol::Hello lockstep(
    protocol::Format format = protocol::Format::kRaw, std::uint32_t max_in_flight = 2);
protocol::Hello interactive(std::uint32_t max_in_flight = 2);

/// One HTTP request on a connection of its own.
HttpReply http_request(std::uint16_t port, const std::string& target,
    boost::beast::http::verb verb = boost::beast::http::verb::get, const Headers& headers = {});

/// Sends bytes as they are and returns everything that comes back until the server closes.
std::string raw_exchange(std::uint16_t port, const std::string& bytes);

}  // namespace farlight
