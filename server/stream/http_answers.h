// HTTP answers: what is said to each request, without sockets.
#pragma once

#include "server/stream/connection.h"

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <map>

namespace farlight {

using HttpResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// A target taken apart: "/snapshot.png?width=320" and so on. Nothing is percent-decoded, as no
/// path and no value we know needs it.
struct Target {
    std::string_view path;
    std::map<std::string_view, std::string_view> query;
};
Target parse_target(std::string_view target);

/// An answer with the headers that every answer carries.
HttpResponse make_answer(const HttpRequest& request, boost::beast::http::status status,
    std::string body, std::string_view content_type = "text/plain; charset=utf-8");

/// The answer to everything but upgrades and snapshots.
HttpResponse answer(const HttpRequest& request, Hub& hub);

/// Why the WebSocket `request` is refused, or nothing: serve it.
std::optional<HttpResponse> refuse_upgrade(const HttpRequest& request, Hub& hub);

/// What GET /snapshot.png asks for, or the answer that refuses it.
std::variant<RenderRequest, HttpResponse> snapshot_request(const HttpRequest& request, Hub& hub);

}  // namespace farlight
