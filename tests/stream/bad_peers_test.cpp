// Peers that send garbage, break the framing, do not read or do not answer: each costs itself only.
#include "tests/stream/server_under_test.h"
#include "tests/stream/session_bench.h"
#include "tests/stream/test_client.h"

#include <algorithm>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

using namespace std::chrono_literals;
using protocol::Format;
using testing::HasSubstr;

/// Resident memory of this process [bytes].
[[maybe_unused]] std::size_t resident_bytes()
{
    std::size_t total = 0;
    std::size_t resident = 0;
    std::ifstream("/proc/self/statm") >> total >> resident;
    return resident * 4096;
}

/// A sample without labels from /metrics.
double metric(std::uint16_t port, const std::string& name)
{
    const std::string text = http_request(port, "/metrics").body();
    const auto line = text.find("\n" + name + " ");
    EXPECT_NE(line, std::string::npos) << name;
    return line == std::string::npos ? 0 : std::stod(text.substr(line + name.size() + 2));
}

TEST(BadPeer, GarbageIsAnsweredAndTheSessionGoesOn)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    for (const char* garbage : {"", "teapot", "[]", "{}", R"({"type":3})", R"({"type":"teapot"})",
             R"({"type":"camera","sequence":-1})", R"({"type":"ack","frame_id":1e99})"}) {
        client.say_text(garbage);
        EXPECT_FALSE(client.next<protocol::Error>().fatal) << garbage;
    }
    client.say(camera_message(1));
    EXPECT_EQ(client.next_frame().header.camera_sequence, 1U);
}

TEST(BadPeer, AHundredRefusedMessagesAreEnough)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    for (int i = 0; i < kMaxRefusedMessages; ++i)
        client.say_text("teapot");
    protocol::Error error;
    while (!error.fatal && !HasFailure())
        error = client.next<protocol::Error>();
    EXPECT_EQ(error.code, protocol::ErrorCode::kTooManyErrors);
    EXPECT_EQ(client.wait_for_close(), 1008);
}

TEST(BadPeer, EndsWithTheCloseCodeOfTheOffence)
{
    ServerUnderTest server;
    const auto offend = [&](const std::string& bytes, bool binary) {
        TestClient client(server.port());
        client.hello(lockstep());
        client.say_text(bytes, binary);
        return client.wait_for_close();
    };
    EXPECT_EQ(offend("x", true), 1003);
    EXPECT_EQ(offend("\xff\xfe", false), 1007);
    EXPECT_EQ(offend(std::string(protocol::kMaxClientTextBytes + 1, ' '), false), 1009);
    EXPECT_EQ(offend(R"({"type":"bye"})", false), 1000);
    EXPECT_EQ(http_request(server.port(), "/healthz").result_int(), 200);
}

TEST(BadPeer, TheLongestMessageAllowedIsRead)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    std::string text = R"({"type":"ping","t":1})";
    text.append(protocol::kMaxClientTextBytes - text.size(), ' ');
    client.say_text(text);
    EXPECT_EQ(client.next<protocol::Pong>().t, 1);
}

struct BrokenFrame {
    const char* name;
    std::string bytes;
};

class BrokenFraming : public testing::TestWithParam<BrokenFrame> { };

/// RFC 6455 section 5.2: what breaks the framing ends the connection, and only that one.
TEST_P(BrokenFraming, EndsOneConnection)
{
    ServerUnderTest server;
    TestClient other(server.port());
    other.hello(lockstep());
    TestClient client(server.port());
    client.hello(lockstep());
    client.write_raw(GetParam().bytes);
    EXPECT_THAT(client.wait_for_close(), testing::AnyOf(1002, 1006, 1007, 1009));
    other.say(camera_message(1));
    EXPECT_EQ(other.next_frame().header.camera_sequence, 1U);
}

INSTANTIATE_TEST_SUITE_P(Rfc6455, BrokenFraming,
    testing::Values(BrokenFrame{"Unmasked", std::string("\x81\x01x", 3)},
        BrokenFrame{"ReservedBit", std::string("\xc1\x80\0\0\0\0", 6)},
        BrokenFrame{"ReservedOpcode", std::string("\x83\x80\0\0\0\0", 6)},
        BrokenFrame{"FragmentedControl", std::string("\x09\x80\0\0\0\0", 6)},
        BrokenFrame{"LongControl", std::string("\x89\xfe\0\x7e\0\0\0\0", 8)},
        BrokenFrame{"ContinuationOfNothing", std::string("\x80\x80\0\0\0\0", 6)},
        BrokenFrame{"LengthBeyondReason",
            std::string("\x81\xff\x7f\xff\xff\xff\xff\xff\xff\xff\0\0\0\0", 14)},
        BrokenFrame{"BadCloseCode", std::string("\x88\x82\0\0\0\0\x03\xe7", 8)}),
    [](const auto& parameter) { return parameter.param.name; });

/// Random bytes, before and after the upgrade: the server neither falls over nor waits for sense.
TEST(BadPeer, NoiseIsSurvived)
{
    StreamOptions options;
    options.http_request = 100ms;
    ServerUnderTest server(options);
    std::mt19937 random(1);
    const auto noise = [&] {
        std::string bytes(random() % 200, '\0');
        std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random()); });
        return bytes;
    };
    for (int i = 0; i < 20; ++i)
        raw_exchange(server.port(), noise());
    for (int i = 0; i < 200; ++i) {
        TestClient client(server.port());
        if (i % 2 == 0)
            client.hello(lockstep());
        client.write_raw(noise());
    }
    EXPECT_EQ(http_request(server.port(), "/healthz").result_int(), 200);
    TestClient client(server.port());
    client.hello(lockstep());
    client.say(camera_message(1));
    EXPECT_EQ(client.next_frame().header.camera_sequence, 1U);
}

TEST(BadPeer, AClientThatDoesNotAcknowledgeGetsItsWindowAndIsThenClosed)
{
    StreamOptions options;
    options.session.acknowledgement = 300ms;
    ServerUnderTest server(options);
    TestClient client(server.port());
    client.hello(interactive(3));
    int frames = 0;
    for (;;) {
        const Received received = client.receive();
        frames += std::holds_alternative<ReceivedFrame>(received) ? 1 : 0;
        if (const auto* closed = std::get_if<Closed>(&received)) {
            EXPECT_EQ(closed->code, 4008);
            break;
        }
    }
    EXPECT_EQ(frames, 3);
}

TEST(BadPeer, AClientThatSaysNothingIsClosed)
{
    StreamOptions options;
    options.session.hello = 200ms;
    ServerUnderTest server(options);
    TestClient client(server.port());
    EXPECT_EQ(client.wait_for_close(), 1008);
}

TEST(BadPeer, APeerThatAnswersPingsStaysAndOneThatDoesNotIsGone)
{
    StreamOptions options;
    options.silence = 400ms;
    ServerUnderTest server(options);
    const TestClient gone(server.port());  // reads nothing, so answers nothing
    TestClient idle(server.port());
    idle.hello(lockstep());
    std::thread later([&] {
        while (metric(server.port(), "farlight_connections") > 1)
            std::this_thread::sleep_for(10ms);
        std::this_thread::sleep_for(3 * options.silence);
        server.listener().shut_down();
    });
    EXPECT_NE(idle.next<protocol::ServerBye>().reason, "");  // reading answers pings
    later.join();
}

/// Raw frames of 1920x1080 are 24.9 MB: no kernel buffer hides them.
TEST(BadPeer, AClientThatNeverReadsCostsBoundedMemoryAndNobodyElseAFrame)
{
    StreamOptions options;
    options.write_progress = 1500ms;
    ServerUnderTest server(options);
    TestClient reader(server.port());
    reader.hello(lockstep());
    TestClient deaf(server.port());
    protocol::Hello hello = lockstep(Format::kRaw, 4);
    hello.size = {{1920, 1080}};
    deaf.hello(hello);
    [[maybe_unused]] const std::size_t before = resident_bytes();
    for (std::uint32_t i = 1; i <= 60; ++i)
        deaf.say(camera_message(i));

    for (std::uint32_t i = 1; i <= 200; ++i) {
        reader.say(camera_message(i));
        ASSERT_EQ(reader.next_frame().header.frame_id, i);
        reader.acknowledge(i);
    }
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep freed memory
    // Four frames in flight; a frame may be held twice while it is encoded.
    EXPECT_LT(resident_bytes(), before + 7 * 1920UL * 1080 * 12);
#endif
    EXPECT_LE(server.renderer().frames_rendered(), 200U + 4U);

    while (server.renderer().sources() > 1)  // until the deaf one is closed and detached
        std::this_thread::sleep_for(10ms);
    reader.say(camera_message(201));
    EXPECT_EQ(reader.next_frame().header.frame_id, 201U);
    EXPECT_THAT(http_request(server.port(), "/metrics").body(),
        HasSubstr("farlight_closes_total{code=\"4008\"} 1"));
}

TEST(BadPeer, AFloodOfMessagesDoesNotStarveAnotherClient)
{
    ServerUnderTest server;
    TestClient reader(server.port());
    reader.hello(lockstep());
    std::atomic<bool> stop = false;
    std::thread flood([&] {
        TestClient client(server.port());
        client.hello(interactive());
        for (std::uint32_t i = 1; !stop; ++i)
            client.say(camera_message(i));
    });
    for (std::uint32_t i = 1; i <= 100; ++i) {
        reader.say(camera_message(i));
        ASSERT_EQ(reader.next_frame().header.frame_id, i);
        reader.acknowledge(i);
    }
    stop = true;
    flood.join();
}

}  // namespace
}  // namespace farlight
