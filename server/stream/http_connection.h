// HttpConnection: one TCP connection while it speaks HTTP. Reads requests against a deadline,
// answers them one at a time, and hands a WebSocket upgrade over to a Connection.
#pragma once

#include "server/stream/http_answers.h"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <optional>

namespace farlight {

class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
public:
    HttpConnection(Hub& hub, boost::asio::ip::tcp::socket socket);
    ~HttpConnection();
    HttpConnection(const HttpConnection&) = delete;
    HttpConnection& operator=(const HttpConnection&) = delete;

    void start() { read(); }

private:
    using ErrorCode = boost::beast::error_code;

    void read();
    void on_read(ErrorCode error);
    void refuse_malformed(ErrorCode error);
    void upgrade();
    void draw_snapshot();
    void send(HttpResponse response);

    Hub& hub_;
    boost::beast::tcp_stream stream_;
    boost::beast::flat_buffer incoming_;
    std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
    HttpRequest request_;
    std::optional<HttpResponse> response_;  ///< Being written.
};

}  // namespace farlight
