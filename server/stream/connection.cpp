// Connection: see the header. Reading first, then the way of a frame, then writing, then the end.
#include "server/stream/connection.h"

#include <array>
#include <boost/asio/post.hpp>
#include <boost/beast/websocket/error.hpp>
#include <spdlog/spdlog.h>

namespace farlight {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using Clock = std::chrono::steady_clock;

constexpr auto kTick = std::chrono::milliseconds(250);
/// Messages that are neither cameras nor useful acknowledgements; those pace themselves.
constexpr double kMessageBurst = 480;
constexpr double kMessagesPerSecond = 240;
/// Answers waiting for a client that does not read; until they are out, its messages wait too.
constexpr std::size_t kMostTexts = 64;
constexpr int kBroken = 1006;  ///< RFC 6455 7.4.1: the connection ended without a close frame.

/// The close code that a failed read stands for.
int code_of(const boost::system::error_code& error, const websocket::close_reason& peer_reason)
{
    if (error == websocket::error::closed)
        return peer_reason.code == websocket::close_code::none ? 1005 : peer_reason.code;
    if (error == websocket::error::message_too_big || error == websocket::error::buffer_overflow)
        return static_cast<int>(CloseCode::kTooBig);
    if (error == websocket::error::bad_frame_payload)
        return 1007;
    return error == websocket::condition::protocol_violation ? 1002 : kBroken;
}

/// The 1st, 2nd, 4th, 8th ... of a kind: a flood must not fill the log.
bool worth_logging(std::uint64_t count)
{
    return (count & (count - 1)) == 0;
}

/// A peer's text, safe to log on one line.
std::string quoted(const std::string& text)
{
    return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace

Connection::Connection(Hub& hub, asio::ip::tcp::socket socket)
    : hub_(hub)
    , name_("s" + std::to_string(++hub.sessions_opened))
    , stream_(std::move(socket))
    , encoder_(asio::make_strand(hub.workers.get_executor()))
    , slot_(std::make_shared<Session::Slot>())
    , session_(hub.session_defaults, name_, slot_, Clock::now())
    , bucket_(kMessageBurst, kMessagesPerSecond, Clock::now())
    , pause_(hub.context)
    , tick_(hub.context)
    , progress_at_(Clock::now())
{
}

Connection::~Connection() = default;

void Connection::start(const HttpRequest& request)
{
    hub_.connections.insert(this);
    hub_.metrics.connection_opened();
    stream_.set_option(websocket::stream_base::timeout{
        hub_.options.http_request, hub_.options.silence, /*keep_alive_pings=*/true});
    stream_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
        response.set(
            beast::http::field::sec_websocket_protocol, std::string(protocol::kSubprotocol));
    }));
    stream_.read_message_max(protocol::kMaxClientTextBytes);
    stream_.auto_fragment(false);
    start_tick();
    stream_.async_accept(request, [self = shared_from_this()](ErrorCode error) {
        if (error)
            return self->end(kBroken, error.message());
        spdlog::info("{}: connected", self->name_);
        self->open_ = true;
        self->advance();  // It may have been told to shut down meanwhile.
    });
}

// ---------------------------------------------------------------- reading

void Connection::resume_reading()
{
    const bool paused = pause_.expiry() > Clock::now();
    if (open_ && !reading_ && !ended_ && !paused && texts_.size() < kMostTexts)
        read();
}

void Connection::read()
{
    reading_ = true;
    stream_.async_read(incoming_, [self = shared_from_this()](ErrorCode error, std::size_t) {
        self->reading_ = false;
        self->on_read(error);
    });
}

void Connection::on_read(ErrorCode error)
{
    if (error)
        return end(code_of(error, stream_.reason()), error.message());
    take_message();
    incoming_.clear();
    advance();
    resume_reading();
}

void Connection::take_message()
{
    if (!stream_.got_text())
        return session_.close(CloseCode::kBinaryRefused, "binary messages are not understood");
    const auto bytes = incoming_.data();
    const auto decoded =
        protocol::decode_client_message({static_cast<const char*>(bytes.data()), bytes.size()});
    const Time now = Clock::now();
    const auto* message = std::get_if<protocol::ClientMessage>(&decoded);
    const bool paces_itself = message != nullptr
        && (std::holds_alternative<protocol::Camera>(*message)
            || std::holds_alternative<protocol::Ack>(*message));
    if (!paces_itself) {
        if (const auto wait = bucket_.take(now); wait > Clock::duration::zero()) {
            pause_.expires_after(wait);
            pause_.async_wait([self = shared_from_this()](ErrorCode error) {
                if (!error)
                    self->resume_reading();
            });
        }
    }
    if (message == nullptr)
        return session_.receive_garbage(std::get<protocol::DecodeError>(decoded));
    if (const auto* hello = std::get_if<protocol::Hello>(message))
        spdlog::info("{}: hello from {}, {}", name_, quoted(hello->client), name_of(hello->mode));
    session_.receive(*message, now);
}

// ---------------------------------------------------------------- what the session decided

void Connection::advance()
{
    if (ended_)
        return;
    carry_out_effects();
    write_next();  // Room on the socket may let the session plan another frame.
    carry_out_effects();
    resume_reading();
}

void Connection::carry_out_effects()
{
    for (SessionEffect& effect : session_.take_effects())
        std::visit([this](auto& known) { carry_out(std::move(known)); }, effect);
}

void Connection::carry_out(const effects::Say& say)
{
    texts_.push_back(protocol::encode(say.message));
}

void Connection::carry_out(effects::Encode encode)
{
    asio::post(encoder_,
        [&metrics = hub_.metrics, executor = hub_.context.get_executor(), weak = weak_from_this(),
            task = std::move(encode.task)] {
            EncodedFrame frame = encode_frame(task);
            metrics.frame_encoded(frame.header.format, frame.header.encode_us * 1e-6);
            asio::post(executor, [weak, frame = std::move(frame)]() mutable {
                if (const auto connection = weak.lock()) {
                    connection->session_.encoded(std::move(frame));
                    connection->advance();
                }
            });
        });
}

void Connection::carry_out(effects::WakeRenderer /*wake*/)
{
    if (!source_) {
        source_ =
            std::make_shared<SlotSource>(slot_, hub_.context.get_executor(), renderer_events());
        hub_.renderer.attach(source_);
    }
    hub_.renderer.wake();
}

/// What the renderer's doings mean here. They hold nothing: a connection may go before them.
SlotSource::Events Connection::renderer_events()
{
    const auto taken = [weak = weak_from_this()] {
        if (const auto self = weak.lock()) {
            self->session_.renderer_took_request();
            self->advance();
        }
    };
    const auto drawn = [weak = weak_from_this()](RenderedFrame frame, Time begun) {
        if (const auto self = weak.lock()) {
            self->hub_.metrics.frame_drawn((frame.trace_ms + frame.denoise_ms) / 1000);
            self->session_.drawn(std::move(frame), begun);
            self->advance();
        }
    };
    return {taken, drawn};
}

void Connection::carry_out(effects::Close close)
{
    if (close.code == CloseCode::kStalled)
        spdlog::warn("{}: closing: {}", name_, close.reason);
    closing_ = std::move(close);
}

void Connection::carry_out(const effects::Acknowledged& acknowledged)
{
    hub_.metrics.frame_acknowledged(acknowledged.times);
}

void Connection::carry_out(const effects::FrameDropped& dropped)
{
    hub_.metrics.frame_dropped(dropped.why);
}

void Connection::carry_out(const effects::MessageRefused& refused)
{
    hub_.metrics.message_refused();
    if (worth_logging(++messages_refused_))
        spdlog::warn("{}: message refused ({} so far): {}", name_, messages_refused_,
            quoted(refused.problem));
}

void Connection::carry_out(const effects::Stepped& stepped)
{
    hub_.metrics.controller_stepped(stepped.times);
}

void Connection::carry_out(effects::Edit edit)
{
    hub_.edit(weak_from_this(), std::move(edit.edit));
}

// ---------------------------------------------------------------- writing

void Connection::write_next()
{
    if (!open_ || writing_ || ended_ || closing_since_)
        return;
    if (!texts_.empty()) {
        stream_.text(true);
        writing_ = true;
        stream_.async_write(asio::buffer(texts_.front()),
            [self = shared_from_this()](
                ErrorCode error, std::size_t) { self->on_written(error, false); });
    } else if (closing_) {
        closing_since_ = Clock::now();
        stream_.async_close({static_cast<websocket::close_code>(closing_->code), closing_->reason},
            [self = shared_from_this()](ErrorCode) {
                self->end(static_cast<int>(self->closing_->code), self->closing_->reason);
            });
    } else if (std::optional<OutgoingFrame> frame = session_.take_frame(Clock::now())) {
        frame_ = std::move(*frame);
        stream_.binary(true);
        writing_ = true;
        stream_.async_write(std::array{asio::buffer(frame_.header), asio::buffer(frame_.payload)},
            [self = shared_from_this()](ErrorCode error, std::size_t bytes) {
                self->hub_.metrics.frame_sent(bytes);
                self->on_written(error, true);
            });
    }
    progress_at_ = Clock::now();
}

void Connection::on_written(ErrorCode error, bool was_frame)
{
    writing_ = false;
    if (error)
        return end(kBroken, error.message());
    if (was_frame) {
        frame_ = {};
        session_.frame_written(Clock::now());
    } else {
        texts_.pop_front();
    }
    advance();
}

// ---------------------------------------------------------------- deadlines and the end

void Connection::start_tick()
{
    tick_.expires_after(kTick);
    tick_.async_wait([self = shared_from_this()](ErrorCode error) {
        if (!error && !self->ended_)
            self->on_tick();
    });
}

void Connection::on_tick()
{
    const Time now = Clock::now();
    session_.tick(now);
    advance();
    check_progress(now);
    if (!ended_)
        start_tick();
}

void Connection::check_progress(Time now)
{
    const std::uint64_t bytes = stream_.next_layer().rate_policy().bytes_written();
    if (!writing_ || bytes != progress_bytes_) {
        progress_bytes_ = bytes;
        progress_at_ = now;
    }
    if (now - progress_at_ >= hub_.options.write_progress)
        hang_up(static_cast<int>(CloseCode::kStalled), "the client does not read");
    else if (closing_since_ && now - *closing_since_ >= hub_.options.close_handshake)
        hang_up(static_cast<int>(closing_->code), "no answer to the close");
}

void Connection::shut_down(const std::string& reason, std::uint32_t reconnect_ms)
{
    session_.shut_down(reason, reconnect_ms);
    advance();
}

void Connection::renderer_failed(const std::string& why)
{
    session_.renderer_failed(why);
    advance();
}

void Connection::scene_changed(
    std::shared_ptr<const SessionDefaults> defaults, std::optional<protocol::Edit> edit)
{
    session_.scene_changed(std::move(defaults), std::move(edit), Clock::now());
    advance();
}

void Connection::edit_refused(const std::string& why, const std::string& pointer)
{
    session_.edit_refused(why, pointer);
    advance();
}

void Connection::detach_now()
{
    if (source_)
        hub_.renderer.detach(source_);
}

void Connection::hang_up(int code, const std::string& why)
{
    beast::get_lowest_layer(stream_).close();
    end(code, why);
}

void Connection::end(int code, const std::string& why)
{
    if (ended_)
        return;
    ended_ = true;
    const int reported = closing_ ? static_cast<int>(closing_->code) : code;
    spdlog::info("{}: ended with {}: {}", name_, reported, why);
    session_.close(CloseCode::kNormal, "");
    tick_.cancel();
    pause_.cancel();
    if (source_)
        hub_.detach_later(std::exchange(source_, nullptr));
    hub_.connections.erase(this);
    hub_.metrics.connection_closed(reported);
    if (hub_.on_connection_gone)
        hub_.on_connection_gone();
}

}  // namespace farlight
