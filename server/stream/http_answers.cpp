// HTTP answers: see the header.
#include "server/stream/http_answers.h"

#include "server/stream/viewer_files.h"

#include <algorithm>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/rfc7230.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <charconv>

namespace farlight {
namespace {

namespace http = boost::beast::http;
using http::field;
using http::status;

/// From a browser's point of view the page needs itself, pictures made from memory, and its socket.
constexpr const char* kContentSecurityPolicy =
    "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view(boost::beast::string_view text)
{
    return {text.data(), text.size()};
}

/// Of a snapshot, unless the server's default is larger: everybody waits while it is drawn.
constexpr Extent kLargestSnapshot{1280, 720};

std::int64_t pixels_of(Extent extent)
{
    return static_cast<std::int64_t>(extent.width) * extent.height;
}

bool offers_subprotocol(const HttpRequest& request)
{
    const http::token_list offered(request[field::sec_websocket_protocol]);
    return std::any_of(offered.begin(), offered.end(),
        [](const auto& name) { return view(name) == protocol::kSubprotocol; });
}

/// Browsers name the page's origin; a page from elsewhere must not steer this server.
bool origin_is_allowed(const HttpRequest& request, const StreamOptions& options)
{
    if (request.find(field::origin) == request.end())
        return true;
    const std::string_view origin = view(request[field::origin]);
    for (const std::string& allowed : options.allowed_origins)
        if (allowed == "*" || boost::beast::iequals(allowed, {origin.data(), origin.size()}))
            return true;
    const auto scheme_end = origin.find("://");
    if (scheme_end == std::string_view::npos || request[field::host].empty())
        return false;
    const std::string_view host = origin.substr(scheme_end + 3);
    return boost::beast::iequals({host.data(), host.size()}, request[field::host]);
}

std::optional<std::uint32_t> number_in(std::string_view text)
{
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return value;
}

std::string_view content_type_of(std::string_view path)
{
    constexpr std::pair<std::string_view, std::string_view> kTypes[] = {
        {".html", "text/html; charset=utf-8"}, {".js", "text/javascript; charset=utf-8"},
        {".css", "text/css; charset=utf-8"}, {".svg", "image/svg+xml"}, {".png", "image/png"},
        {".ico", "image/x-icon"}};
    for (const auto& [ending, type] : kTypes)
        if (path.ends_with(ending))
            return type;
    return "application/octet-stream";
}

HttpResponse reject(
    const HttpRequest& request, Hub& hub, status why, std::string body, const std::string& reason)
{
    hub.metrics.handshake_rejected(reason);
    return make_answer(request, why, std::move(body));
}

}  // namespace

Target parse_target(std::string_view target)
{
    Target parsed;
    const auto mark = target.find('?');
    parsed.path = target.substr(0, mark);
    std::string_view rest = mark == std::string_view::npos ? "" : target.substr(mark + 1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find('&'));
        rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
        const auto equals = pair.find('=');
        parsed.query[pair.substr(0, equals)] =
            equals == std::string_view::npos ? "" : pair.substr(equals + 1);
    }
    return parsed;
}

HttpResponse make_answer(
    const HttpRequest& request, status status, std::string body, std::string_view content_type)
{
    HttpResponse response{status, request.version()};
    response.set(field::server, "farlight/" FARLIGHT_VERSION);
    response.set(field::content_type, {content_type.data(), content_type.size()});
    response.set(field::cache_control, "no-cache");
    response.set("Content-Security-Policy", kContentSecurityPolicy);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.keep_alive(request.keep_alive());
    response.body() = std::move(body);
    response.prepare_payload();
    if (request.method() == http::verb::head)
        response.body().clear();  // Content-Length stays that of GET.
    return response;
}

HttpResponse answer(const HttpRequest& request, Hub& hub)
{
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
        HttpResponse response =
            make_answer(request, status::method_not_allowed, "only GET and HEAD\n");
        response.set(field::allow, "GET, HEAD");
        response.keep_alive(false);
        return response;
    }
    const std::string_view path = parse_target(view(request.target())).path;
    if (path == "/healthz")
        return make_answer(request, status::ok, "ok\n");
    if (path == "/readyz") {
        const std::string why = hub.not_ready();
        return make_answer(request, why.empty() ? status::ok : status::service_unavailable,
            (why.empty() ? "ready" : why) + "\n");
    }
    if (path == "/metrics")
        return make_answer(request, status::ok,
            hub.metrics.text(hub.renderer, hub.frames_in_flight()),
            "text/plain; version=0.0.4; charset=utf-8");
    if (path == protocol::kEndpoint) {
        HttpResponse response = make_answer(request, status::upgrade_required,
            "this is a WebSocket: subprotocol " + std::string(protocol::kSubprotocol) + "\n");
        response.set(field::upgrade, "websocket");
        return response;
    }
    if (path.starts_with('/')) {
        const auto file = viewer_files().find(path == "/" ? "index.html" : path.substr(1));
        if (file != viewer_files().end())
            return make_answer(request, status::ok, file->second, content_type_of(file->first));
    }
    return make_answer(request, status::not_found, "nothing is here\n");
}

std::optional<HttpResponse> refuse_upgrade(const HttpRequest& request, Hub& hub)
{
    if (parse_target(view(request.target())).path != protocol::kEndpoint)
        return reject(request, hub, status::not_found,
            "the WebSocket is at " + std::string(protocol::kEndpoint) + "\n", "path");
    if (!origin_is_allowed(request, hub.options))
        return reject(request, hub, status::forbidden,
            "pages from this origin may not connect; the server's --allow-origin can let them\n",
            "origin");
    if (!offers_subprotocol(request)) {
        HttpResponse response = reject(request, hub, status::upgrade_required,
            "offer one of these in Sec-WebSocket-Protocol: " + std::string(protocol::kSubprotocol)
                + "\n",
            "subprotocol");
        response.set(field::upgrade, "websocket");
        return response;
    }
    const std::string why = hub.not_ready();
    const bool full = hub.connections.size() >= static_cast<std::size_t>(hub.options.max_clients);
    if (why.empty() && !full)
        return std::nullopt;
    HttpResponse response = reject(request, hub, status::service_unavailable,
        (full ? "all " + std::to_string(hub.options.max_clients) + " places are taken" : why)
            + "\n",
        full ? "capacity" : "not_ready");
    response.set(field::retry_after, "2");
    return response;
}

std::variant<RenderRequest, HttpResponse> snapshot_request(const HttpRequest& request, Hub& hub)
{
    // An <img> in any page sends no Origin, but browsers say where it comes from.
    if (boost::beast::iequals(request["Sec-Fetch-Site"], "cross-site"))
        return make_answer(
            request, status::forbidden, "pages from other sites may not ask for pictures\n");
    RenderRequest wanted = hub.session_defaults->request;
    for (const auto& [key, value] : parse_target(view(request.target())).query) {
        const std::optional<std::uint32_t> number = number_in(value);
        if ((key != "width" && key != "height") || !number)
            return make_answer(request, status::bad_request,
                "found '" + std::string(key) + "=" + std::string(value)
                    + "', expected width=N or height=N\n");
        const int pixels = static_cast<int>(std::min(*number, std::uint32_t{1U << 30U}));
        (key == "width" ? wanted.extent.width : wanted.extent.height) = pixels;
    }
    if (const auto problem = refuse_extent(static_cast<std::uint64_t>(wanted.extent.width),
            static_cast<std::uint64_t>(wanted.extent.height), hub.session_defaults->max_dimension))
        return make_answer(request, status::bad_request, *problem + "\n");
    const std::int64_t most =
        std::max(pixels_of(hub.session_defaults->request.extent), pixels_of(kLargestSnapshot));
    if (pixels_of(wanted.extent) > most)
        return make_answer(request, status::bad_request,
            "found " + std::to_string(pixels_of(wanted.extent)) + " pixels, expected at most "
                + std::to_string(most) + " in a snapshot\n");
    const std::string why = hub.not_ready();
    if (why.empty() && !hub.snapshot)
        return wanted;
    HttpResponse response = make_answer(request, status::service_unavailable,
        (why.empty() ? "another snapshot is being drawn" : why) + "\n");
    response.set(field::retry_after, "2");
    return response;
}

}  // namespace farlight
