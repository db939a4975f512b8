// Session: pacing under random interleavings, and the ends a session can come to. What a session
// says in ordinary cases is told by the scripts in sessions/.
#include "tests/stream/session_bench.h"

#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

using namespace std::chrono_literals;
using protocol::Mode;

/// One random step; acknowledgements come in order, as a client sends them.
void random_step(SessionBench& bench, std::mt19937& random, std::uint32_t& acknowledged, Mode mode)
{
    switch (random() % 8) {
    case 0:
        if (mode == Mode::kInteractive || bench.newest_camera - bench.sent.size() < 60)
            bench.move_camera(bench.newest_camera + 1);
        break;
    case 1:
        if (acknowledged < bench.sent.size())
            bench.acknowledge(++acknowledged);
        break;
    case 2: bench.renderer_takes(); break;
    case 3: bench.renderer_finishes(); break;
    case 4: bench.encoder_finishes(); break;
    case 5: bench.socket_takes(); break;
    case 6: bench.socket_finishes(); break;
    default: bench.pass_time(std::chrono::milliseconds(random() % 20)); break;
    }
}

class RandomInterleavings : public testing::TestWithParam<std::uint32_t> { };

TEST_P(RandomInterleavings, InteractiveDrawsTheNewestCameraAndStaysWithinTheWindow)
{
    std::mt19937 random(GetParam());
    const std::uint32_t window = 1 + random() % protocol::kMaxInFlight;
    SessionBench bench;
    bench.hello(Mode::kInteractive, window, /*still_samples=*/20);
    std::uint32_t acknowledged = 0;
    for (int step = 0; step < 2000; ++step) {
        const std::size_t taken = bench.taken.size();
        random_step(bench, random, acknowledged, Mode::kInteractive);
        ASSERT_LE(bench.session().frames_in_flight(), static_cast<int>(window)) << "step " << step;
        ASSERT_LE(bench.sent.size() - acknowledged, window) << "step " << step;
        if (bench.taken.size() > taken && bench.newest_camera > 0) {
            ASSERT_EQ(bench.taken.back().camera.position.x, bench.newest_camera) << "step " << step;
        }
    }
    bench.settle();
    while (acknowledged < bench.sent.size()) {
        bench.acknowledge(++acknowledged);
        bench.settle();
    }
    ASSERT_FALSE(bench.sent.empty());
    const protocol::FrameHeader& last = bench.sent.back().header;
    EXPECT_EQ(last.camera_sequence, bench.newest_camera);
    EXPECT_TRUE(last.has(protocol::frame_flags::kConverged));
    EXPECT_TRUE(last.has(protocol::frame_flags::kLossless));
    EXPECT_EQ(bench.session().frames_in_flight(), 0);
    for (std::size_t i = 0; i < bench.sent.size(); ++i)
        ASSERT_EQ(bench.sent[i].header.frame_id, i + 1);
    for (std::size_t i = 1; i < bench.sent.size(); ++i)
        ASSERT_GE(bench.sent[i].header.camera_sequence, bench.sent[i - 1].header.camera_sequence);
}

TEST_P(RandomInterleavings, LockstepDrawsEachCameraOnceInOrderWithinTheWindow)
{
    std::mt19937 random(GetParam());
    const std::uint32_t window = 1 + random() % protocol::kMaxInFlight;
    SessionBench bench;
    bench.hello(Mode::kLockstep, window, /*still_samples=*/1);
    std::uint32_t acknowledged = 0;
    for (int step = 0; step < 2000; ++step) {
        random_step(bench, random, acknowledged, Mode::kLockstep);
        ASSERT_LE(bench.session().frames_in_flight(), static_cast<int>(window)) << "step " << step;
        ASSERT_LE(bench.sent.size() - acknowledged, window) << "step " << step;
    }
    bench.settle();
    while (acknowledged < bench.sent.size()) {
        bench.acknowledge(++acknowledged);
        bench.settle();
    }
    ASSERT_EQ(bench.sent.size(), bench.newest_camera);
    for (std::size_t i = 0; i < bench.sent.size(); ++i) {
        ASSERT_EQ(bench.sent[i].header.camera_sequence, i + 1);
        ASSERT_FALSE(bench.sent[i].header.has(protocol::frame_flags::kStill));
    }
    EXPECT_EQ(bench.frames_dropped, 0);
    EXPECT_FALSE(bench.session().closed());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomInterleavings, testing::Range(1U, 26U));

TEST(Session, AnOvertakenFrameIsNeverSent)
{
    SessionBench bench;
    bench.hello(Mode::kInteractive, 8);
    bench.move_camera(1);
    bench.renderer_takes();
    bench.move_camera(2);
    bench.renderer_takes();
    for (int i = 0; i < 2; ++i) {
        bench.renderer_finishes();
        bench.encoder_finishes();
    }
    bench.socket_takes();
    EXPECT_EQ(bench.sent.back().header.camera_sequence, 2U);
    EXPECT_EQ(bench.sent.back().header.frame_id, 1U);
    EXPECT_EQ(bench.frames_dropped, 1);
}

TEST(Session, ASocketThatTakesNothingStopsTheRenderer)
{
    SessionBench bench;
    bench.hello(Mode::kInteractive, 8);
    bench.renderer_takes(), bench.renderer_finishes(), bench.encoder_finishes();
    bench.socket_takes();  // and never finishes
    int drawn = 0;
    for (int camera = 1; camera <= 100; ++camera) {
        bench.move_camera(static_cast<std::uint32_t>(camera));
        drawn += bench.renderer_takes() ? 1 : 0;
        bench.renderer_finishes(), bench.encoder_finishes(), bench.socket_takes();
    }
    EXPECT_LE(drawn, 8);
}

TEST(Session, HugeFramesAreNotHeldInMemoryByTheDozen)
{
    SessionBench bench;
    protocol::Hello hello;
    hello.mode = Mode::kLockstep;
    hello.format = protocol::Format::kRaw;
    hello.size = {{4096, 4096}};  // 192 MiB a frame
    hello.max_in_flight = 8;
    bench.receive(hello);
    for (std::uint32_t i = 1; i <= 8; ++i)
        bench.move_camera(i);
    bench.settle();
    EXPECT_EQ(bench.sent.size(), 1U);
    bench.acknowledge(1);
    bench.settle();
    EXPECT_EQ(bench.sent.size(), 2U);
}

TEST(Session, AnErrorOfTheRendererEndsTheSessionWithItsReason)
{
    SessionBench bench;
    bench.hello(Mode::kInteractive, 2);
    bench.take_events();
    bench.renderer_takes();
    RenderedFrame frame;
    frame.error = "context lost";
    bench.session().drawn(std::move(frame), bench.now);
    bench.pass_time(0ms);
    const auto events = bench.take_events();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0]["code"], "render_failed");
    EXPECT_EQ(events[0]["message"], "context lost");
    EXPECT_EQ(events[0]["fatal"], true);
    EXPECT_EQ(events[1]["code"], 1011);
}

TEST(Session, FramesThatComeBackAfterTheEndAreForgotten)
{
    SessionBench bench;
    bench.hello(Mode::kInteractive, 4);
    bench.renderer_takes(), bench.renderer_finishes();
    bench.renderer_takes();
    bench.session().close(CloseCode::kNormal, "bye");
    EXPECT_FALSE(bench.renderer_takes()) << "the slot is emptied";
    bench.renderer_finishes();
    bench.encoder_finishes();
    EXPECT_FALSE(bench.socket_takes());
}

}  // namespace
}  // namespace farlight
