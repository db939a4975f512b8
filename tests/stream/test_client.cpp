// TestClient: see the header.
#include "tests/stream/test_client.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <gtest/gtest.h>

namespace farlight {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

tcp::endpoint loopback(std::uint16_t port)
{
    return {asio::ip::address_v4::loopback(), port};
}

}  // namespace

/// Runs `start(handler)` to its end; error_ says how it went.
template <typename Start> void TestClient::run(Start start)
{
    bool done = false;
    start([&](beast::error_code error, auto...) {
        error_ = error;
        done = true;
    });
    context_.restart();
    context_.run_for(kPatience);
    if (!done) {
        ADD_FAILURE() << "the server was waited for in vain";
        beast::get_lowest_layer(stream_).close();
        context_.restart();
        context_.run();
    }
}

TestClient::TestClient(std::uint16_t port, const Headers& headers, const std::string& subprotocol)
    : stream_(context_)
{
    beast::get_lowest_layer(stream_).connect(loopback(port));
    beast::get_lowest_layer(stream_).socket().set_option(tcp::no_delay(true));
    stream_.set_option(websocket::stream_base::decorator([=](websocket::request_type& request) {
        if (!subprotocol.empty())
            request.set(http::field::sec_websocket_protocol, subprotocol);
        for (const auto& [name, value] : headers)
            request.set(name, value);
    }));
    stream_.read_message_max(0);
    run([&](auto handler) {
        stream_.async_handshake(
            upgrade_reply_, "127.0.0.1:" + std::to_string(port), "/ws", handler);
    });
    http_status_ = upgrade_reply_.result_int();
}

void TestClient::say(const protocol::ClientMessage& message)
{
    say_text(protocol::encode(message));
}

void TestClient::say_text(const std::string& text, bool binary)
{
    stream_.binary(binary);
    run([&](auto handler) { stream_.async_write(asio::buffer(text), handler); });
}

void TestClient::write_raw(const std::string& bytes)
{
    run([&](auto handler) {
        asio::async_write(beast::get_lowest_layer(stream_), asio::buffer(bytes), handler);
    });
}

Received TestClient::receive()
{
    incoming_.clear();
    run([&](auto handler) { stream_.async_read(incoming_, handler); });
    if (error_ == websocket::error::closed)
        return Closed{stream_.reason().code};
    if (error_)
        return Closed{};
    const auto data = incoming_.data();
    if (stream_.got_text()) {
        auto decoded =
            protocol::decode_server_message({static_cast<const char*>(data.data()), data.size()});
        if (auto* error = std::get_if<protocol::DecodeError>(&decoded))
            ADD_FAILURE() << "unreadable message: " << to_string(*error);
        else
            return std::get<protocol::ServerMessage>(std::move(decoded));
    }
    const auto decoded =
        protocol::decode_frame({static_cast<const std::byte*>(data.data()), data.size()});
    if (const auto* error = std::get_if<protocol::DecodeError>(&decoded)) {
        ADD_FAILURE() << "unreadable frame: " << to_string(*error);
        return Closed{};
    }
    const auto& view = std::get<protocol::FrameView>(decoded);
    return ReceivedFrame{view.header, {view.payload.begin(), view.payload.end()}};
}

template <typename Message> Message TestClient::next()
{
    for (;;) {
        Received received = receive();
        if (const auto* closed = std::get_if<Closed>(&received)) {
            ADD_FAILURE() << "closed with " << closed->code << " before a " << Message::kType;
            return {};
        }
        if (auto* message = std::get_if<protocol::ServerMessage>(&received))
            if (auto* wanted = std::get_if<Message>(message))
                return std::move(*wanted);
    }
}

template protocol::Welcome TestClient::next();
template protocol::State TestClient::next();
template protocol::Error TestClient::next();
template protocol::Pong TestClient::next();
template protocol::ServerBye TestClient::next();
template protocol::SceneChanged TestClient::next();
template protocol::Inspection TestClient::next();

ReceivedFrame TestClient::next_frame()
{
    for (;;) {
        Received received = receive();
        if (const auto* closed = std::get_if<Closed>(&received)) {
            ADD_FAILURE() << "closed with " << closed->code << " before a frame";
            return {};
        }
        if (auto* frame = std::get_if<ReceivedFrame>(&received))
            return std::move(*frame);
    }
}

int TestClient::wait_for_close()
{
    for (;;) {
        const Received received = receive();
        if (const auto* closed = std::get_if<Closed>(&received))
            return closed->code;
    }
}

protocol::Welcome TestClient::hello(const protocol::Hello& hello)
{
    say(hello);
    return next<protocol::Welcome>();
}

void TestClient::acknowledge(std::uint32_t frame_id)
{
    say(protocol::Ack{frame_id, std::nullopt, std::nullopt});
}

protocol::Hello lockstep(protocol::Format format, std::uint32_t max_in_flight)
{
    protocol::Hello hello;
    hello.client = "test";
    hello.mode = protocol::Mode::kLockstep;
    hello.format = format;
    hello.max_in_flight = max_in_flight;
    return hello;
}

protocol::Hello interactive(std::uint32_t max_in_flight)
{
    protocol::Hello hello;
    hello.client = "test";
    hello.max_in_flight = max_in_flight;
    hello.settings["still_samples"] = 16;
    return hello;
}

HttpReply http_request(
    std::uint16_t port, const std::string& target, http::verb verb, const Headers& headers)
{
    asio::io_context context;
    beast::tcp_stream stream(context);
    stream.connect(loopback(port));
    http::request<http::string_body> request{verb, target, 11};
    request.set(http::field::host, "127.0.0.1:" + std::to_string(port));
    for (const auto& [name, value] : headers)
        request.set(name, value);
    http::write(stream, request);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    parser.skip(verb == http::verb::head);
    stream.expires_after(kPatience);
    beast::error_code failed;
    http::async_read(
        stream, buffer, parser, [&](beast::error_code error, std::size_t) { failed = error; });
    context.run();
    EXPECT_FALSE(failed) << target << ": " << failed.message();
    return parser.release();
}

std::string raw_exchange(std::uint16_t port, const std::string& bytes)
{
    asio::io_context context;
    beast::tcp_stream stream(context);
    stream.connect(loopback(port));
    asio::write(stream.socket(), asio::buffer(bytes));
    std::string answer;
    stream.expires_after(kPatience);
    beast::error_code failed;
    asio::async_read(stream, asio::dynamic_buffer(answer),
        [&](beast::error_code error, std::size_t) { failed = error; });
    context.run();
    EXPECT_NE(failed, beast::error::timeout) << "the server keeps the connection open";
    return answer;
}

}  // namespace farlight
