// HttpConnection: see the header.
#include "server/stream/http_connection.h"

#include "server/stream/snapshot.h"

#include <boost/asio/post.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <spdlog/spdlog.h>

namespace farlight {
namespace {

namespace asio = boost::asio;
namespace http = boost::beast::http;

constexpr std::uint32_t kMostHeaderBytes = 8 * 1024;

/// The snapshot's last frame as PNG, on a worker.
EncodedFrame encode_snapshot(RenderedFrame frame)
{
    if (!frame.error.empty())
        return {.error = std::move(frame.error)};
    EncodeTask task{std::move(frame.image)};
    task.header.format = protocol::Format::kPng;
    return encode_frame(task);
}

}  // namespace

HttpConnection::HttpConnection(Hub& hub, asio::ip::tcp::socket socket)
    : hub_(hub)
    , stream_(std::move(socket))
{
    ++hub_.http_connections;
}

HttpConnection::~HttpConnection()
{
    --hub_.http_connections;
}

void HttpConnection::read()
{
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(0);
    stream_.expires_after(hub_.options.http_request);
    http::async_read(stream_, incoming_, *parser_,
        [self = shared_from_this()](ErrorCode error, std::size_t) { self->on_read(error); });
}

void HttpConnection::on_read(ErrorCode error)
{
    if (error)
        return refuse_malformed(error);
    request_ = parser_->release();
    if (boost::beast::websocket::is_upgrade(request_))
        return upgrade();
    if (request_.method() == http::verb::get
        && parse_target({request_.target().data(), request_.target().size()}).path
            == "/snapshot.png")
        return draw_snapshot();
    send(answer(request_, hub_));
}

void HttpConnection::refuse_malformed(ErrorCode error)
{
    const bool is_http_error =
        error.category() == make_error_code(http::error::bad_method).category();
    if (!is_http_error || error == http::error::end_of_stream
        || error == http::error::partial_message)
        return;  // Gone, or too slow: the socket closes with this object.
    spdlog::debug("bad HTTP request: {}", error.message());
    http::status status = http::status::bad_request;
    if (error == http::error::header_limit)
        status = http::status::request_header_fields_too_large;
    else if (error == http::error::body_limit)
        status = http::status::payload_too_large;
    request_ = {};
    request_.keep_alive(false);
    send(make_answer(request_, status, error.message() + "\n"));
}

void HttpConnection::upgrade()
{
    if (std::optional<HttpResponse> refusal = refuse_upgrade(request_, hub_)) {
        refusal->keep_alive(false);
        return send(std::move(*refusal));
    }
    std::make_shared<Connection>(hub_, stream_.release_socket())->start(request_);
}

void HttpConnection::draw_snapshot()
{
    auto wanted = snapshot_request(request_, hub_);
    if (auto* refusal = std::get_if<HttpResponse>(&wanted))
        return send(std::move(*refusal));
    stream_.expires_never();  // Drawing takes its time.
    const auto answer_with = [self = shared_from_this()](EncodedFrame frame) {
        self->hub_.detach_later(std::exchange(self->hub_.snapshot, nullptr));
        if (!frame.error.empty())
            return self->send(
                make_answer(self->request_, http::status::service_unavailable, frame.error + "\n"));
        self->send(make_answer(self->request_, http::status::ok,
            {frame.payload.begin(), frame.payload.end()}, "image/png"));
    };
    hub_.snapshot = std::make_shared<Snapshot>(
        std::get<RenderRequest>(wanted), [&hub = hub_, answer_with](RenderedFrame frame) {
            asio::post(hub.workers, [&hub, answer_with, frame = std::move(frame)]() mutable {
                asio::post(hub.context,
                    [answer_with, encoded = encode_snapshot(std::move(frame))]() mutable {
                        answer_with(std::move(encoded));
                    });
            });
        });
    hub_.renderer.attach(hub_.snapshot);
    hub_.renderer.wake();
}

void HttpConnection::send(HttpResponse response)
{
    response_ = std::move(response);
    stream_.expires_after(hub_.options.http_request);
    http::async_write(
        stream_, *response_, [self = shared_from_this()](ErrorCode error, std::size_t) {
            const bool keep = !error && self->response_->keep_alive();
            self->response_.reset();
            if (keep)
                self->read();
            else
                self->stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, error);
        });
}

}  // namespace farlight
