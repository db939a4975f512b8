// WebSocket sessions over real loopback sockets: upgrades, several clients, shutting
// down.
#include "tests/stream/server_under_test.h"
#include "tests/stream/session_bench.h"
#include "tests/stream/test_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xxhash.h>

namespace farlight {
namespace {

using namespace std::chrono_literals;
using protocol::Format;
using protocol::Mode;
using testing::HasSubstr;

// ---------------------------------------------------------------- upgrades

struct Upgrade {
    const char* name;
    Headers headers;
    const char* subprotocol;
    int status;
};

class Upgrades : public testing::TestWithParam<Upgrade> { };

TEST_P(Upgrades, AreServedOrRefusedBeforeTheWebSocketBegins)
{
    StreamOptions options;
    options.allowed_origins = {"https://friend.example"};
    ServerUnderTest server(options);
    Headers headers = GetParam().headers;
    if (const auto origin = headers.find("Origin");
        origin != headers.end() && origin->second == "SELF")
        origin->second = "http://127.0.0.1:" + std::to_string(server.port());
    const TestClient client(server.port(), headers, GetParam().subprotocol);
    EXPECT_EQ(client.http_status(), GetParam().status) << client.upgrade_reply().body();
    if (GetParam().status == 426) {
        EXPECT_THAT(client.upgrade_reply().body(), HasSubstr("farlight.v1"));
    }
    if (GetParam().status == 101) {
        EXPECT_EQ(client.upgrade_reply()["Sec-WebSocket-Protocol"], "farlight.v1");
    }
}

INSTANTIATE_TEST_SUITE_P(Offers, Upgrades,
    testing::Values(Upgrade{"Plain", {}, "farlight.v1", 101},
        Upgrade{"AmongOthers", {}, "farlight.v2, farlight.v1", 101},
        Upgrade{"NoSubprotocol", {}, "", 426}, Upgrade{"OtherSubprotocol", {}, "farlight.v2", 426},
        Upgrade{"OwnOrigin", {{"Origin", "SELF"}}, "farlight.v1", 101},
        Upgrade{"AllowedOrigin", {{"Origin", "https://friend.example"}}, "farlight.v1", 101},
        Upgrade{"OtherOrigin", {{"Origin", "http://evil.example"}}, "farlight.v1", 403},
        Upgrade{"OtherPort", {{"Origin", "http://127.0.0.1:1"}}, "farlight.v1", 403},
        Upgrade{"NullOrigin", {{"Origin", "null"}}, "farlight.v1", 403},
        Upgrade{"EmptyOrigin", {{"Origin", ""}}, "farlight.v1", 403}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(WebSocket, OneClientTooManyIsToldToComeBack)
{
    StreamOptions options;
    options.max_clients = 1;
    ServerUnderTest server(options);
    const TestClient first(server.port());
    EXPECT_EQ(first.http_status(), 101);
    const TestClient second(server.port());
    EXPECT_EQ(second.http_status(), 503);
    EXPECT_EQ(second.upgrade_reply()["Retry-After"], "2");
}

// ---------------------------------------------------------------- pictures

TEST(WebSocket, WelcomeSaysWhatHolds)
{
    ServerUnderTest server;
    TestClient client(server.port());
    const protocol::Welcome welcome = client.hello(lockstep(Format::kPng, 3));
    EXPECT_EQ(welcome.protocol, "farlight.v1");
    EXPECT_EQ(welcome.scene.name, "gradient");
    EXPECT_EQ(welcome.gl_renderer, "FakeRenderer");
    EXPECT_EQ(welcome.size, (protocol::Size{64, 36}));
    EXPECT_EQ(welcome.max_in_flight, 3U);
    EXPECT_EQ(welcome.limits.max_dimension, 4096U);
    EXPECT_EQ(welcome.settings.size(), describe_settings({}, {}).size());
}

TEST(WebSocket, ARawFrameIsWhatTheRendererDrew)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    client.say(camera_message(3));
    const ReceivedFrame frame = client.next_frame();

    RenderRequest request;
    request.camera.position.x = 3;
    request.extent = {64, 36};
    request.format = PixelFormat::kRgb32f;
    EXPECT_EQ(frame.payload, fake_picture(request, 0).bytes);
    EXPECT_EQ(frame.header.frame_id, 1U);
    EXPECT_EQ(frame.header.camera_sequence, 3U);
    EXPECT_EQ(frame.header.framebuffer_hash, XXH64(frame.payload.data(), frame.payload.size(), 0));
    EXPECT_TRUE(frame.header.has(protocol::frame_flags::kHistoryReset));
    ASSERT_EQ(frame.header.passes.size(), 1U);
    EXPECT_EQ(frame.header.passes[0].name, "fake");
}

TEST(WebSocket, InteractiveEndsInOneLosslessStill)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(interactive());
    client.say(camera_message(1));
    for (;;) {
        const ReceivedFrame frame = client.next_frame();
        client.acknowledge(frame.header.frame_id);
        if (!frame.header.has(protocol::frame_flags::kConverged))
            continue;
        EXPECT_EQ(frame.header.format, Format::kPng);
        EXPECT_TRUE(frame.header.has(protocol::frame_flags::kLossless));
        if (frame.header.camera_sequence == 1)
            break;
    }
    client.say(protocol::Ping{7});
    const Received next = client.receive();
    ASSERT_TRUE(std::holds_alternative<protocol::ServerMessage>(next)) << "another frame came";
    EXPECT_TRUE(std::holds_alternative<protocol::Pong>(std::get<protocol::ServerMessage>(next)));
}

TEST(WebSocket, TwoClientsHaveTheirOwnCameras)
{
    ServerUnderTest server;
    TestClient first(server.port());
    TestClient second(server.port());
    first.hello(lockstep());
    second.hello(lockstep());
    std::vector<std::uint64_t> hashes[2];
    for (std::uint32_t i = 1; i <= 20; ++i) {
        first.say(camera_message(i));
        second.say(camera_message(1000 + i));
        for (auto [client, which] : {std::pair(&first, 0), std::pair(&second, 1)}) {
            const ReceivedFrame frame = client->next_frame();
            EXPECT_EQ(frame.header.camera_sequence, i + (which == 1 ? 1000 : 0));
            hashes[which].push_back(frame.header.framebuffer_hash);
            client->acknowledge(frame.header.frame_id);
        }
    }
    EXPECT_NE(hashes[0], hashes[1]);
}

TEST(WebSocket, LockstepTwiceGivesTheSameBytes)
{
    ServerUnderTest server;
    std::vector<std::uint64_t> hashes[2];
    for (auto& run : hashes) {
        TestClient client(server.port());
        client.hello(lockstep(Format::kPng));
        for (std::uint32_t i = 1; i <= 10; ++i) {
            client.say(camera_message(i));
            const ReceivedFrame frame = client.next_frame();
            run.push_back(XXH64(frame.payload.data(), frame.payload.size(), 0));
            client.acknowledge(i);
        }
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

// ---------------------------------------------------------------- how it ends

TEST(WebSocket, AClientThatGoesAwayIsDetachedFromTheRenderer)
{
    ServerUnderTest server;
    {
        TestClient client(server.port());
        client.hello(interactive());
        client.next_frame();
    }
    while (server.renderer().sources() > 0)
        std::this_thread::sleep_for(1ms);
    EXPECT_THAT(
        http_request(server.port(), "/metrics").body(), HasSubstr("farlight_connections 0"));
}

TEST(WebSocket, SessionsAreToldWhenTheRendererFails)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    server.renderer().fail("the context is lost");
    const auto error = client.next<protocol::Error>();
    EXPECT_EQ(error.code, protocol::ErrorCode::kRenderFailed);
    EXPECT_EQ(error.message, "the context is lost");
    EXPECT_EQ(client.wait_for_close(), 1011);
}

TEST(WebSocket, AFrameThatCannotBeDrawnEndsTheSessionNotTheServer)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    server.renderer().fail_frames("no such shader");
    client.say(camera_message(1));
    EXPECT_EQ(client.next<protocol::Error>().message, "no such shader");
    EXPECT_EQ(client.wait_for_close(), 1011);
    server.renderer().fail_frames("");
    TestClient again(server.port());
    again.hello(lockstep());
    again.say(camera_message(1));
    EXPECT_EQ(again.next_frame().header.frame_id, 1U);
}

TEST(WebSocket, ShuttingDownSaysGoodbyeToEveryClient)
{
    ServerUnderTest server;
    TestClient first(server.port());
    TestClient second(server.port());
    first.hello(interactive());
    second.hello(lockstep());
    server.listener().shut_down();
    for (TestClient* client : {&first, &second}) {
        const auto bye = client->next<protocol::ServerBye>();
        EXPECT_GT(bye.reconnect_ms, 0U);
        EXPECT_EQ(client->wait_for_close(), 1001);
    }
    server.join();
}

TEST(WebSocket, ShuttingDownDoesNotWaitForADeafClientForEver)
{
    StreamOptions options;
    options.drain = 300ms;
    ServerUnderTest server(options);
    TestClient deaf(server.port());
    protocol::Hello hello = lockstep();
    hello.size = {{1920, 1080}};
    deaf.hello(hello);
    deaf.say(camera_message(1));
    while (server.renderer().frames_rendered() == 0)
        std::this_thread::sleep_for(1ms);
    server.listener().shut_down();
    server.join();
}

}  // namespace
}  // namespace farlight
