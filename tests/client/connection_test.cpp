// The connection against a server that behaves, and against some that do not.
#include "client/session.h"
#include "tests/client/fake_server.h"

#include <gmock/gmock.h>
#include <latch>

namespace farlight {
namespace {

using namespace client;
using namespace protocol;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::ThrowsMessage;

const Hello lockstep_hello{.client = "test", .mode = Mode::kLockstep, .format = Format::kRaw};

TEST(Url, PartsAndDefaults)
{
    EXPECT_EQ(parse_url("ws://host:8080/ws"), (Url{"host", "8080", "/ws"}));
    EXPECT_EQ(parse_url("ws://host"), (Url{"host", "80", "/ws"}));
    EXPECT_EQ(parse_url("ws://[::1]:99/x"), (Url{"::1", "99", "/x"}));
    for (const char* bad :
        {"", "http://host/", "ws://", "ws://:80/", "ws://h:port/", "ws://h:65536/", "ws://h:/ws"})
        EXPECT_THROW(parse_url(bad), std::invalid_argument) << bad;
}

TEST(Connection, NobodyListensIsAnError)
{
    boost::asio::io_context io;
    boost::asio::ip::tcp::acceptor taken(io, {boost::asio::ip::make_address("127.0.0.1"), 0});
    const auto port = std::to_string(taken.local_endpoint().port());
    taken.close();
    EXPECT_THROW(Connection(Url{"127.0.0.1", port, "/ws"}), ConnectionError);
}

TEST(Connection, AnotherSubprotocolIsAnError)
{
    FakeServer server([](FakePeer&) {}, "farlight.v9");
    EXPECT_THAT([&] { Connection connection(server.url()); },
        ThrowsMessage<ConnectionError>(
            HasSubstr("found subprotocol 'farlight.v9', expected farlight.v1")));
}

TEST(Connection, AServerThatNeverShakesHandsTimesOut)
{
    boost::asio::io_context io;
    boost::asio::ip::tcp::acceptor silent(io, {boost::asio::ip::make_address("127.0.0.1"), 0});
    const Url url{"127.0.0.1", std::to_string(silent.local_endpoint().port()), "/ws"};
    EXPECT_THAT([&] { Connection connection(url, std::chrono::milliseconds(50)); },
        ThrowsMessage<ConnectionError>(HasSubstr("no answer in time")));
}

TEST(Session, LockstepGivesOneFrameACamera)
{
    FakeServer server([](FakePeer& peer) { serve_lockstep(peer, {}); });
    Session session(server.url(), lockstep_hello);
    EXPECT_EQ(session.welcome().scene.name, "Fake");
    for (std::uint32_t i = 1; i <= 5; ++i) {
        const Frame frame = session.draw(session.welcome().camera);
        EXPECT_EQ(frame.header.frame_id, i);
        EXPECT_EQ(frame.header.camera_sequence, i);
        EXPECT_EQ(decode_picture(frame.header, frame.payload).linear.size(), 16U * 8 * 3);
    }
    session.set("seed", 3);
    session.close();
}

TEST(Session, WaitsForTheScenesOwnProgramsAndNoLongerThanItIsTold)
{
    FakeServer server([](FakePeer& peer) { serve_lockstep(peer, {}); });
    Session session(server.url(), lockstep_hello);
    const Pose pose = session.welcome().camera;
    EXPECT_FALSE(drawn_with_own_programs(session.await_own_programs(pose, {})));
    const Inspection own = session.await_own_programs(pose, std::chrono::minutes(5));
    EXPECT_EQ(own.program, (std::vector<std::string>{"fog", "denoising"}));
}

TEST(Session, EditsAndInspects)
{
    FakeServer server([](FakePeer& peer) { serve_lockstep(peer, {}); });
    Session session(server.url(), lockstep_hello);
    EXPECT_EQ(session.edit({{"medium", nullptr}}).edit, 1U);
    EXPECT_EQ(session.edit(nlohmann::json::object(), /*reset=*/true).edit, 2U);
    EXPECT_EQ(session.inspect().program, (std::vector<std::string>{"fog", "denoising", "lens"}));
    try {
        session.edit({{"bad", 1}});
        FAIL() << "accepted";
    } catch (const RefusedError& refused) {
        EXPECT_EQ(refused.error.code, ErrorCode::kEditRefused);
        EXPECT_EQ(refused.error.field, "/bad");
    }
    EXPECT_EQ(session.edit(nlohmann::json::object()).edit, 4U) << "the session goes on";
}

TEST(Session, ARefusalInHelloNamesTheSetting)
{
    FakeServer server(
        [](FakePeer& peer) { serve_lockstep(peer, {.refuses_setting = "sharpness"}); });
    Hello hello = lockstep_hello;
    hello.settings["sharpness"] = 11;
    EXPECT_THAT([&] { Session session(server.url(), hello); },
        ThrowsMessage<RefusedError>(HasSubstr("setting 'sharpness' is unknown")));
}

struct Misbehaviour {
    const char* name;
    FakeServer::Handler after_welcome;
    const char* complaint;
};
class SessionReports : public testing::TestWithParam<Misbehaviour> { };

TEST_P(SessionReports, WhatTheServerDidWrong)
{
    FakeServer server([](FakePeer& peer) {
        peer.read();
        peer.send(fake_welcome());
        GetParam().after_welcome(peer);
        while (true)
            peer.read();
    });
    Session session(server.url(), lockstep_hello);
    EXPECT_THAT(
        [&] { session.draw({}); }, ThrowsMessage<SessionError>(HasSubstr(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(Servers, SessionReports,
    testing::Values(
        Misbehaviour{"GarbageFrame",
            [](FakePeer& peer) { peer.send_binary(std::vector<std::byte>(100, std::byte{7})); },
            "magic is not FARL"},
        Misbehaviour{"EmptyFrame", [](FakePeer& peer) { peer.send_binary({}); }, "has 0 bytes"},
        Misbehaviour{
            "GarbageText", [](FakePeer& peer) { peer.send_text("{\"type\":"); }, "is not JSON"},
        Misbehaviour{"UnknownMessage",
            [](FakePeer& peer) { peer.send_text(R"({"type":"teapot"})"); },
            "type is unknown: teapot"},
        Misbehaviour{"WrongSequence",
            [](FakePeer& peer) { peer.send_frame({.camera_sequence = 9}, {}); },
            "found a frame of camera 9, expected 1"},
        Misbehaviour{"FatalError",
            [](FakePeer& peer) {
                peer.send(Error{.code = ErrorCode::kRenderFailed,
                    .message = "the device is lost",
                    .fatal = true});
            },
            "the server breaks off: the device is lost"},
        Misbehaviour{"Bye", [](FakePeer& peer) { peer.send(ServerBye{.reason = "tea time"}); },
            "the server says bye: tea time"},
        Misbehaviour{
            "Close", [](FakePeer& peer) { peer.close(4008, "stalled"); }, "4008 (stalled)"},
        Misbehaviour{"Drop", [](FakePeer& peer) { peer.drop(); }, "the connection broke"}),
    [](const auto& tested) { return tested.param.name; });

TEST(Connection, AfterTheEndThereIsOnlyTheEnd)
{
    FakeServer server([](FakePeer& peer) { peer.close(1001, "going"); });
    Connection connection(server.url());
    for (int i = 0; i < 2; ++i) {
        const auto event = connection.receive(seconds(5));
        ASSERT_TRUE(event && std::holds_alternative<Closed>(*event));
        EXPECT_EQ(std::get<Closed>(*event).code, 1001);
    }
    EXPECT_THROW(connection.send(Ping{}), ConnectionError);
}

TEST(Connection, SilenceIsNothingAndReceivingGoesOnAfterIt)
{
    std::latch asked(1);
    FakeServer server([&](FakePeer& peer) {
        asked.wait();
        peer.send(Pong{.t = 3});
        peer.read();
    });
    Connection connection(server.url());
    EXPECT_FALSE(connection.receive(std::chrono::milliseconds(1)));
    asked.count_down();
    const auto event = connection.receive(seconds(5));
    ASSERT_TRUE(event && std::holds_alternative<ServerMessage>(*event));
    EXPECT_EQ(std::get<Pong>(std::get<ServerMessage>(*event)).t, 3);
}

}  // namespace
}  // namespace farlight
