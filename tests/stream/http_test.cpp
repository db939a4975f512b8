// HTTP over real sockets: every route, and what is refused.
#include "server/stream/http_answers.h"
#include "tests/stream/server_under_test.h"
#include "tests/stream/test_client.h"

#include <boost/asio/write.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stb/stb_image.h>

namespace farlight {
namespace {

using boost::beast::http::verb;
using testing::HasSubstr;
using testing::StartsWith;

struct Route {
    const char* name;
    const char* target;
    int status;
    const char* content_type;
    const char* body_has;
};

class HttpRoutes : public testing::TestWithParam<Route> { };

TEST_P(HttpRoutes, AnswersGetAndHead)
{
    ServerUnderTest server;
    const auto [name, target, status, content_type, body_has] = GetParam();
    const HttpReply reply = http_request(server.port(), target);
    EXPECT_EQ(reply.result_int(), status);
    EXPECT_THAT(std::string(reply["Content-Type"]), StartsWith(content_type));
    EXPECT_THAT(reply.body(), HasSubstr(body_has));
    EXPECT_EQ(reply["X-Content-Type-Options"], "nosniff");
    EXPECT_THAT(std::string(reply["Content-Security-Policy"]), HasSubstr("default-src 'self'"));

    const HttpReply head = http_request(server.port(), target, verb::head);
    EXPECT_EQ(head.result_int(), status);
    EXPECT_EQ(head.body(), "");
}

INSTANTIATE_TEST_SUITE_P(Routes, HttpRoutes,
    testing::Values(Route{"Viewer", "/", 200, "text/html", "<html"},
        Route{"ViewerWithQuery", "/?session=1", 200, "text/html", "<html"},
        Route{"ViewerScript", "/viewer.js", 200, "text/javascript", "import"},
        Route{"ViewerStyle", "/style.css", 200, "text/css", "{"},
        Route{"Health", "/healthz", 200, "text/plain", "ok"},
        Route{"Ready", "/readyz", 200, "text/plain", "ready"},
        Route{"Metrics", "/metrics", 200, "text/plain; version=0.0.4", "farlight_connections 0"},
        Route{"WebSocketWithoutUpgrade", "/ws", 426, "text/plain", "farlight.v1"},
        Route{"ViewerPicture", "/icon.svg", 200, "image/svg+xml", "<svg"},
        Route{"NotForBrowsers", "/package.json", 404, "text/plain", ""},
        Route{"Unknown", "/teapot", 404, "text/plain", ""},
        Route{"NoPath", "?x=1", 404, "text/plain", ""},
        Route{"Traversal", "/../server/main.cpp", 404, "text/plain", ""},
        Route{"EncodedTraversal", "/%2e%2e/CMakeLists.txt", 404, "text/plain", ""},
        Route{"AbsolutePath", "//etc/passwd", 404, "text/plain", ""}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(Http, MetricsTellBadValuesByStageAndKindFromTheStart)
{
    ServerUnderTest server;
    const std::string row = "farlight_bad_values_total{kind=\"negative\",stage=\"composite\"} ";
    EXPECT_THAT(http_request(server.port(), "/metrics").body(), HasSubstr(row + "0\n"));
    BadValues met;
    met.counts()[STAGE_COMPOSITE * KIND_COUNT + KIND_NEGATIVE] = 3;
    for (int frame = 0; frame < 2; ++frame) {
        server.renderer().meet(met);
        EXPECT_THAT(http_request(server.port(), "/metrics").body(),
            HasSubstr(row + std::to_string(3 * (frame + 1)) + "\n"));
    }
}

TEST(Http, RefusesOtherMethods)
{
    ServerUnderTest server;
    for (const verb method : {verb::post, verb::put, verb::delete_, verb::options}) {
        const HttpReply reply = http_request(server.port(), "/", method);
        EXPECT_EQ(reply.result_int(), 405);
        EXPECT_EQ(reply["Allow"], "GET, HEAD");
    }
}

TEST(Http, RefusesMalformedAndOversizedRequests)
{
    ServerUnderTest server;
    EXPECT_THAT(raw_exchange(server.port(), "teapot\r\n\r\n"), HasSubstr(" 400 "));
    EXPECT_THAT(raw_exchange(server.port(),
                    "GET / HTTP/1.1\r\nHost: a\r\nX: " + std::string(10000, 'x') + "\r\n\r\n"),
        HasSubstr(" 431 "));
    EXPECT_THAT(
        raw_exchange(server.port(), "GET / HTTP/1.1\r\nHost: a\r\nContent-Length: 100\r\n\r\n"),
        HasSubstr(" 413 "));
    EXPECT_EQ(http_request(server.port(), "/healthz").result_int(), 200);
}

TEST(Http, ASlowHeaderIsNotWaitedFor)
{
    StreamOptions options;
    options.http_request = std::chrono::milliseconds(200);
    ServerUnderTest server(options);
    EXPECT_EQ(raw_exchange(server.port(), "GET / HTTP/1.1\r\nHo"), "");
    EXPECT_EQ(raw_exchange(server.port(), ""), "");
}

TEST(Http, ServesSeveralRequestsOnOneConnection)
{
    ServerUnderTest server;
    const std::string request = "GET /healthz HTTP/1.1\r\nHost: a\r\n\r\n";
    const std::string last = "GET /readyz HTTP/1.1\r\nHost: a\r\nConnection: close\r\n\r\n";
    const std::string answers = raw_exchange(server.port(), request + request + last);
    EXPECT_THAT(answers, HasSubstr("ok\n"));
    EXPECT_THAT(answers, HasSubstr("ready\n"));
}

TEST(Http, ReadyzTellsThatTheRendererFailed)
{
    ServerUnderTest server;
    server.renderer().fail("the context is lost");
    const HttpReply reply = http_request(server.port(), "/readyz");
    EXPECT_EQ(reply.result_int(), 503);
    EXPECT_THAT(reply.body(), HasSubstr("the context is lost"));
    EXPECT_EQ(http_request(server.port(), "/healthz").result_int(), 200);
    EXPECT_EQ(http_request(server.port(), "/snapshot.png").result_int(), 503);
    EXPECT_EQ(TestClient(server.port()).http_status(), 503);
}

Extent size_of_png(const std::string& png)
{
    Extent extent;
    int channels = 0;
    const int length = static_cast<int>(png.size());
    stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()), length,
        &extent.width, &extent.height, &channels, 3);
    EXPECT_NE(pixels, nullptr);
    stbi_image_free(pixels);
    return extent;
}

TEST(Http, SnapshotIsAPngOfTheSizeAskedFor)
{
    ServerUnderTest server;
    const HttpReply reply = http_request(server.port(), "/snapshot.png");
    EXPECT_EQ(reply.result_int(), 200);
    EXPECT_EQ(reply["Content-Type"], "image/png");
    EXPECT_EQ(size_of_png(reply.body()), server.renderer().description()->default_extent);
    EXPECT_EQ(size_of_png(http_request(server.port(), "/snapshot.png?width=20&height=10").body()),
        (Extent{20, 10}));
}

TEST(Http, SnapshotRefusesSizesItCannotDraw)
{
    ServerUnderTest server;
    for (const char* query : {"width=0", "width=-1", "width=5000", "height=x", "width=", "depth=1",
             "width=99999999999999", "height=4294967295"})
        EXPECT_EQ(
            http_request(server.port(), std::string("/snapshot.png?") + query).result_int(), 400)
            << query;
}

TEST(Http, SnapshotHasNoMorePixelsThanItsLimit)
{
    ServerUnderTest server;  // whose default size is smaller
    const HttpReply most = http_request(server.port(), "/snapshot.png?width=720&height=1280");
    EXPECT_EQ(size_of_png(most.body()), (Extent{720, 1280}));
    const HttpReply more = http_request(server.port(), "/snapshot.png?width=1281&height=720");
    EXPECT_EQ(more.result_int(), 400);
    EXPECT_EQ(more.body(), "found 922320 pixels, expected at most 921600 in a snapshot\n");
}

TEST(Http, SnapshotIsNotForOtherSitesPages)
{
    ServerUnderTest server;
    const auto status_for = [&](const char* site) {
        return http_request(server.port(), "/snapshot.png", verb::get, {{"Sec-Fetch-Site", site}})
            .result_int();
    };
    EXPECT_EQ(status_for("cross-site"), 403);
    EXPECT_EQ(server.renderer().frames_rendered(), 0U);
    EXPECT_EQ(status_for("same-origin"), 200);
    EXPECT_EQ(status_for("none"), 200) << "typed into the address bar";
}

TEST(Http, SnapshotPassesOnWhyDrawingFailed)
{
    ServerUnderTest server;
    server.renderer().fail_frames("no such shader");
    const HttpReply reply = http_request(server.port(), "/snapshot.png");
    EXPECT_EQ(reply.result_int(), 503);
    EXPECT_EQ(reply.body(), "no such shader\n");
}

TEST(Http, OneSnapshotAtATime)
{
    ServerUnderTest server({}, std::chrono::milliseconds(20));
    boost::asio::io_context context;
    boost::asio::ip::tcp::socket first(context);
    first.connect({boost::asio::ip::address_v4::loopback(), server.port()});
    boost::asio::write(
        first, boost::asio::buffer(std::string("GET /snapshot.png HTTP/1.1\r\nHost: a\r\n\r\n")));
    while (server.renderer().frames_rendered() == 0)
        std::this_thread::yield();
    const HttpReply second = http_request(server.port(), "/snapshot.png");
    EXPECT_EQ(second.result_int(), 503);
    EXPECT_EQ(second["Retry-After"], "2");
}

TEST(Listener, SaysWhatToDoWhenThePortIsInUse)
{
    ServerUnderTest server;
    StreamOptions options;
    options.port = server.port();
    FakeRenderer renderer;
    try {
        const Listener second(renderer, options);
        FAIL() << "two listeners on one port";
    } catch (const ListenError& problem) {
        EXPECT_EQ(problem.what(),
            "port " + std::to_string(server.port())
                + " on 127.0.0.1 is in use: choose another with --port, 0 picks a free one");
    }
}

TEST(Listener, RefusesAnAddressThatIsNone)
{
    StreamOptions options;
    options.bind = "localhorst";
    FakeRenderer renderer;
    EXPECT_THROW(Listener(renderer, options), ListenError);
}

TEST(Listener, SaysItsUrl)
{
    ServerUnderTest server;
    EXPECT_EQ(server.listener().url(), "http://127.0.0.1:" + std::to_string(server.port()) + "/");
}

TEST(ParseTarget, TakesPathAndQueryApart)
{
    const Target target = parse_target("/a/b.png?width=1&height=&x");
    EXPECT_EQ(target.path, "/a/b.png");
    const std::map<std::string_view, std::string_view> expected{
        {"width", "1"}, {"height", ""}, {"x", ""}};
    EXPECT_EQ(target.query, expected);
    EXPECT_TRUE(parse_target("/").query.empty());
    EXPECT_EQ(parse_target("").path, "");
}

}  // namespace
}  // namespace farlight
