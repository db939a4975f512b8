// The WebSocket, by Boost.Beast: asynchronous operations, run by the caller until done or too late.
#include "client/connection.h"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/websocket.hpp>

namespace farlight::client {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;
using boost::system::error_code;

namespace {
constexpr std::size_t kMaxMessageBytes =
    1'000'000'000;  // a raw frame of the largest size is 805 MB
constexpr std::chrono::seconds kSendTimeout{30};
constexpr std::chrono::seconds kCloseTimeout{3};
}  // namespace

Url parse_url(const std::string& text)
{
    constexpr std::string_view kScheme = "ws://";
    const auto refuse = [&] {
        throw std::invalid_argument("found '" + text + "', expected ws://HOST:PORT/ws");
    };
    if (!text.starts_with(kScheme))
        refuse();
    const std::string rest = text.substr(kScheme.size());
    const auto slash = rest.find('/');
    const std::string authority = rest.substr(0, slash);
    const auto bracket = authority.find(']');
    const auto colon = authority.find(':', bracket == std::string::npos ? 0 : bracket);

    Url url;
    url.path = slash == std::string::npos ? std::string(protocol::kEndpoint) : rest.substr(slash);
    url.host = authority.substr(0, colon);
    url.port = colon == std::string::npos ? "80" : authority.substr(colon + 1);
    if (url.host.starts_with('[') && url.host.ends_with(']'))
        url.host = url.host.substr(1, url.host.size() - 2);
    const bool port_ok = !url.port.empty() && url.port.size() <= 5
        && url.port.find_first_not_of("0123456789") == std::string::npos
        && std::stoi(url.port) <= 65535;
    if (url.host.empty() || !port_ok)
        refuse();
    return url;
}

struct Connection::Socket {
    asio::io_context io;
    websocket::stream<beast::tcp_stream> stream{io};
    beast::flat_buffer buffer;
    bool reading = false;
    std::optional<Event> arrived;
    std::optional<Closed> closed;

    /// Runs until `done` or the deadline; true when done.
    template <typename Done> bool run_until(Clock::time_point deadline, Done&& done)
    {
        while (!done()) {
            if (io.stopped())
                io.restart();
            if (io.run_one_until(deadline) == 0 && Clock::now() >= deadline)
                return done();
        }
        return true;
    }

    /// Runs one operation, started by `start(handler)`, to its end. Throws ConnectionError.
    template <typename Start>
    void finish(const std::string& what, Clock::time_point deadline, Start&& start)
    {
        std::optional<error_code> result;
        start([&](error_code error, auto&&...) { result = error; });
        if (!run_until(deadline, [&] { return result.has_value(); })) {
            beast::get_lowest_layer(stream).cancel();
            run_until(Clock::time_point::max(), [&] { return result.has_value(); });
            throw ConnectionError(what + ": no answer in time");
        }
        if (*result)
            throw ConnectionError(what + ": " + result->message());
    }

    void start_reading()
    {
        if (reading || arrived || closed)
            return;
        reading = true;
        stream.async_read(buffer, [this](error_code error, std::size_t) {
            reading = false;
            if (error)
                closed = Closed{stream.reason().code,
                    stream.reason().code != 0 ? std::string(stream.reason().reason.c_str())
                                              : error.message()};
            else
                take_message();
            buffer.consume(buffer.size());
        });
    }

    void take_message()
    {
        const auto* bytes = static_cast<const char*>(buffer.data().data());
        if (stream.got_text()) {
            auto decoded = protocol::decode_server_message({bytes, buffer.size()});
            if (auto* message = std::get_if<protocol::ServerMessage>(&decoded))
                arrived = std::move(*message);
            else
                arrived = std::get<protocol::DecodeError>(decoded);
            return;
        }
        auto decoded = protocol::decode_frame(std::as_bytes(std::span(bytes, buffer.size())));
        if (auto* view = std::get_if<protocol::FrameView>(&decoded))
            arrived = Frame{std::move(view->header), {view->payload.begin(), view->payload.end()},
                Clock::now()};
        else
            arrived = std::get<protocol::DecodeError>(decoded);
    }
};

Connection::Connection(const Url& url, std::chrono::milliseconds timeout)
    : socket_(std::make_unique<Socket>())
{
    const std::string where = url.host + ":" + url.port;
    const auto deadline = Clock::now() + timeout;
    error_code error;
    asio::ip::tcp::resolver resolver(socket_->io);
    const auto endpoints = resolver.resolve(url.host, url.port, error);
    if (error)
        throw ConnectionError(where + ": " + error.message());

    auto& stream = socket_->stream;
    socket_->finish(where, deadline, [&](auto handler) {
        beast::get_lowest_layer(stream).async_connect(endpoints, std::move(handler));
    });
    beast::get_lowest_layer(stream).expires_never();
    beast::get_lowest_layer(stream).socket().set_option(asio::ip::tcp::no_delay(true), error);

    stream.read_message_max(kMaxMessageBytes);
    stream.set_option(websocket::stream_base::decorator([](websocket::request_type& request) {
        request.set(beast::http::field::sec_websocket_protocol, protocol::kSubprotocol);
        request.set(beast::http::field::user_agent, "farlight " FARLIGHT_VERSION);
    }));
    websocket::response_type response;
    socket_->finish(where + url.path + ": WebSocket handshake", deadline, [&](auto handler) {
        stream.async_handshake(response, where, url.path, std::move(handler));
    });
    const auto selected = response[beast::http::field::sec_websocket_protocol];
    if (selected != protocol::kSubprotocol)
        throw ConnectionError(where + url.path + ": found subprotocol '" + std::string(selected)
            + "', expected " + std::string(protocol::kSubprotocol));
}

Connection::~Connection() = default;

void Connection::send(const protocol::ClientMessage& message)
{
    send_text(protocol::encode(message));
}

void Connection::send_text(const std::string& text)
{
    if (socket_->closed)
        throw ConnectionError(
            "the server has closed the connection: " + to_string(*socket_->closed));
    socket_->stream.text(true);
    socket_->finish("sending", Clock::now() + kSendTimeout,
        [&](auto handler) { socket_->stream.async_write(asio::buffer(text), std::move(handler)); });
}

std::optional<Event> Connection::receive(std::chrono::milliseconds timeout)
{
    socket_->start_reading();
    socket_->run_until(Clock::now() + timeout,
        [&] { return socket_->arrived.has_value() || socket_->closed.has_value(); });
    if (socket_->arrived)
        return std::exchange(socket_->arrived, std::nullopt);
    if (socket_->closed)
        return *socket_->closed;
    return std::nullopt;
}

void Connection::close()
{
    const auto deadline = Clock::now() + kCloseTimeout;
    try {
        if (!socket_->closed)
            send(protocol::ClientBye{});
        while (!socket_->closed && Clock::now() < deadline)
            receive(std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()));
    } catch (const ConnectionError&) {  // the server was quicker
    }
}

std::string to_string(const Closed& closed)
{
    if (closed.code == 0)
        return "the connection broke (" + closed.reason + ")";
    return std::to_string(closed.code) + (closed.reason.empty() ? "" : " (" + closed.reason + ")");
}

}  // namespace farlight::client
