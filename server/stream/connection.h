// Connection: one WebSocket. Carries out what its Session decides, and minds what only a socket can
// know: who does not read, who floods, who is gone. Network thread only.
#pragma once

#include "server/stream/hub.h"
#include "server/stream/slot_source.h"
#include "server/stream/token_bucket.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core/basic_stream.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <deque>

namespace farlight {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;

/// Limits nothing; notes how many bytes the socket has taken, so that a stuck write can be told
/// from a slow one.
class WriteProgress {
public:
    std::uint64_t bytes_written() const { return bytes_written_; }

private:
    friend class boost::beast::rate_policy_access;

    static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
    std::size_t available_read_bytes() const noexcept { return kAll; }
    std::size_t available_write_bytes() const noexcept { return kAll; }
    void transfer_read_bytes(std::size_t /*count*/) const noexcept { }
    void transfer_write_bytes(std::size_t count) noexcept { bytes_written_ += count; }
    void on_timer() const noexcept { }

    std::uint64_t bytes_written_ = 0;
};

class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(Hub& hub, boost::asio::ip::tcp::socket socket);
    ~Connection();
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    /// Answers the upgrade `request`, which has been checked, and serves until the end.
    void start(const HttpRequest& request);
    void shut_down(const std::string& reason, std::uint32_t reconnect_ms);
    void renderer_failed(const std::string& why);
    void scene_changed(
        std::shared_ptr<const SessionDefaults> defaults, std::optional<protocol::Edit> edit);
    void edit_refused(const std::string& why, const std::string& pointer);
    /// Stops the renderer from calling; may wait for a frame being drawn. Only for the very end.
    void detach_now();

    int frames_in_flight() const { return session_.frames_in_flight(); }

private:
    using Stream = boost::beast::websocket::stream<boost::beast::basic_stream<boost::asio::ip::tcp,
        boost::asio::any_io_executor, WriteProgress>>;
    using ErrorCode = boost::beast::error_code;
    using Time = Session::Time;

    void read();
    void on_read(ErrorCode error);
    void take_message();
    void resume_reading();

    void advance();
    void carry_out_effects();
    void carry_out(const effects::Say& say);
    void carry_out(effects::Encode encode);
    void carry_out(effects::WakeRenderer wake);
    void carry_out(effects::Close close);
    void carry_out(const effects::Acknowledged& acknowledged);
    void carry_out(const effects::FrameDropped& dropped);
    void carry_out(const effects::MessageRefused& refused);
    void carry_out(const effects::Stepped& stepped);
    void carry_out(effects::Edit edit);
    SlotSource::Events renderer_events();

    void write_next();
    void on_written(ErrorCode error, bool was_frame);
    void start_tick();
    void on_tick();
    void check_progress(Time now);
    void hang_up(int code, const std::string& why);
    void end(int code, const std::string& why);

    Hub& hub_;
    std::string name_;
    Stream stream_;
    boost::asio::strand<boost::asio::thread_pool::executor_type>
        encoder_;  ///< Keeps frames in order.
    std::shared_ptr<Session::Slot> slot_;
    Session session_;
    std::shared_ptr<SlotSource> source_;  ///< Since the renderer was first asked for a frame.

    boost::beast::flat_buffer incoming_;
    TokenBucket bucket_;
    boost::asio::steady_timer pause_;  ///< Until the next message may be read.
    bool reading_ = false;

    std::deque<std::string> texts_;  ///< Messages to write; the first may be being written.
    OutgoingFrame frame_;  ///< Being written, if `writing_` and no text is.
    bool writing_ = false;
    std::optional<effects::Close> closing_;  ///< To close once all texts are out.
    std::optional<Time> closing_since_;

    boost::asio::steady_timer tick_;
    std::uint64_t progress_bytes_ = 0;
    Time progress_at_;
    std::uint64_t messages_refused_ = 0;
    bool open_ = false;  ///< The upgrade is answered.
    bool ended_ = false;
};

}  // namespace farlight
