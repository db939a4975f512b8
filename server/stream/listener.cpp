// Listener: see the header.
#include "server/stream/listener.h"

#include "server/stream/connection.h"
#include "server/stream/http_connection.h"

#include <boost/asio/post.hpp>
#include <spdlog/spdlog.h>
#include <vector>

namespace farlight {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr auto kRendererWatch = std::chrono::milliseconds(500);
constexpr auto kAcceptRetry = std::chrono::milliseconds(100);  ///< When file descriptors run out.
/// Kernel buffers hide stale frames from pacing: enough for one picture, no more.
constexpr int kSendBufferBytes = 128 * 1024;
constexpr std::uint32_t kReconnectMs = 1000;
constexpr int kMostHttpConnections = 256;

tcp::endpoint endpoint_of(const StreamOptions& options)
{
    boost::system::error_code error;
    const auto address = asio::ip::make_address(options.bind, error);
    if (error)
        throw ListenError("--bind: found '" + options.bind
            + "', expected an IP address, as 127.0.0.1, 0.0.0.0 or ::1");
    return {address, options.port};
}

tcp::acceptor open_acceptor(asio::io_context& context, const StreamOptions& options)
{
    const tcp::endpoint endpoint = endpoint_of(options);
    try {
        return {context, endpoint};
    } catch (const boost::system::system_error& problem) {
        const std::string where = "port " + std::to_string(options.port) + " on " + options.bind;
        if (problem.code() == asio::error::address_in_use)
            throw ListenError(where + " is in use: choose another with --port, 0 picks a free one");
        throw ListenError(where + " cannot be listened on: " + problem.code().message());
    }
}

}  // namespace

Listener::Listener(RenderService& renderer, const StreamOptions& options)
    : hub_(renderer, options)
    , acceptor_(open_acceptor(hub_.context, options))
    , retry_accept_(hub_.context)
    , renderer_watch_(hub_.context)
    , drain_deadline_(hub_.context)
{
    hub_.on_connection_gone = [this] { stop_if_drained(); };
}

Listener::~Listener()
{
    // Nobody runs the context any more; see to it that nobody posts to it either.
    for (Connection* connection : hub_.connections)
        connection->detach_now();
    if (hub_.snapshot)
        hub_.renderer.detach(hub_.snapshot);
    hub_.detacher.join();
    hub_.workers.join();
}

std::string Listener::url() const
{
    const tcp::endpoint endpoint = acceptor_.local_endpoint();
    const std::string address = endpoint.address().to_string();
    return "http://" + (endpoint.address().is_v6() ? "[" + address + "]" : address) + ":"
        + std::to_string(endpoint.port()) + "/";
}

std::uint16_t Listener::port() const
{
    return acceptor_.local_endpoint().port();
}

void Listener::run()
{
    accept();
    watch_renderer();
    hub_.context.run();
}

void Listener::shut_down()
{
    asio::post(hub_.context, [this] { drain(); });
}

void Listener::accept()
{
    acceptor_.async_accept([this](boost::system::error_code error, tcp::socket socket) {
        if (error == asio::error::operation_aborted)
            return;
        if (!error) {
            admit(std::move(socket));
            return accept();
        }
        spdlog::warn("a connection could not be accepted: {}", error.message());
        retry_accept_.expires_after(kAcceptRetry);
        retry_accept_.async_wait([this](boost::system::error_code aborted) {
            if (!aborted)
                accept();
        });
    });
}

void Listener::admit(tcp::socket socket)
{
    if (hub_.http_connections >= kMostHttpConnections)
        return;  // Closes it.
    boost::system::error_code ignored;  // A socket without these options still works.
    socket.set_option(tcp::no_delay(true), ignored);
    socket.set_option(asio::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    std::make_shared<HttpConnection>(hub_, std::move(socket))->start();
}

void Listener::watch_renderer()
{
    if (const std::string failure = hub_.renderer.failure(); !failure.empty()) {
        spdlog::error("the renderer failed: {}", failure);
        const std::vector<Connection*> connections(
            hub_.connections.begin(), hub_.connections.end());
        for (Connection* connection : connections)
            connection->renderer_failed(failure);
        return;
    }
    renderer_watch_.expires_after(kRendererWatch);
    renderer_watch_.async_wait([this](boost::system::error_code error) {
        if (!error)
            watch_renderer();
    });
}

void Listener::drain()
{
    if (hub_.draining)
        return;
    hub_.draining = true;
    spdlog::info("shutting down; {} clients connected", hub_.connections.size());
    drain_deadline_.expires_after(hub_.options.drain);
    drain_deadline_.async_wait([this](boost::system::error_code error) {
        if (!error)
            hub_.context.stop();
    });
    const std::vector<Connection*> connections(hub_.connections.begin(), hub_.connections.end());
    for (Connection* connection : connections)
        connection->shut_down("the server is shutting down", kReconnectMs);
    stop_if_drained();
}

void Listener::stop_if_drained()
{
    if (hub_.draining && hub_.connections.empty())
        hub_.context.stop();
}

}  // namespace farlight
