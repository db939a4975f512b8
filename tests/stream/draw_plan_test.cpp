// DrawPlan: the newest camera wins, a resting picture is refined until it is final, lockstep draws
// all.
#include "server/stream/draw_plan.h"
#include "server/stream/encoder.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

using namespace std::chrono_literals;
using protocol::Format;
using protocol::Mode;

constexpr Draw::Time kStart{1h};

DrawPlan make_plan(Mode mode, Format format = Format::kJpeg420)
{
    RenderRequest request;
    request.extent = {64, 36};
    return {mode, request, format, kStart};
}

CameraPose pose_at(double x)
{
    CameraPose pose;
    pose.position = {x, 0, 5};
    return pose;
}

TEST(DrawPlan, InteractiveDrawsAtOnceWithCameraSequenceZero)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    const auto draw = plan.next();
    ASSERT_TRUE(draw.has_value());
    EXPECT_EQ(draw->camera_sequence, 0U);
    EXPECT_EQ(draw->session_epoch, 1U);
    EXPECT_EQ(draw->asked, kStart);
    EXPECT_FALSE(draw->request.live);
    EXPECT_TRUE(plan.next()->request.live);
    plan.set_settings({}, kStart);
    EXPECT_FALSE(plan.next()->request.live);
}

TEST(DrawPlan, RefinesFromTheSecondFrameOfAnUnmovedCameraOn)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    const bool expected[] = {false, false, true, true};
    for (const bool refine : expected)
        EXPECT_EQ(plan.next()->request.refine, refine);

    plan.move_camera(pose_at(1), 1, false, kStart);
    for (const bool refine : expected)
        EXPECT_EQ(plan.next()->request.refine, refine);
}

/// Looking at a resting picture in another way does not stir it; moving does.
TEST(DrawPlan, ARestingPictureRestsOnWhenOnlySettingsChange)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    RenderSettings settings = plan.wishes().settings;
    const auto change = [&](float exposure) {
        settings.exposure = exposure;
        plan.set_settings(settings, kStart);
    };
    plan.next();
    change(2);
    EXPECT_FALSE(plan.next()->request.refine) << "it does not rest yet";
    plan.next();
    const Draw resting = *plan.next();
    EXPECT_TRUE(resting.request.refine);
    change(3);
    change(4);
    EXPECT_TRUE(plan.newer_than(resting)->request.refine);
    EXPECT_TRUE(plan.next()->request.refine);
    EXPECT_TRUE(plan.next()->request.refine);
    change(5);
    plan.move_camera(pose_at(1), 1, false, kStart);
    change(6);
    EXPECT_FALSE(plan.next()->request.refine);
    EXPECT_FALSE(plan.next()->request.refine);
    EXPECT_TRUE(plan.next()->request.refine);
}

TEST(DrawPlan, IsSilentAfterTheFinalPictureUntilSomethingChanges)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    const Draw draw = *plan.next();
    EXPECT_FALSE(plan.repeats_final(draw));
    plan.settle(draw);
    EXPECT_TRUE(plan.repeats_final(draw));
    EXPECT_FALSE(plan.next().has_value());

    RenderSettings settings = plan.wishes().settings;
    settings.exposure = 2;
    plan.set_settings(settings, kStart + 1s);
    const auto next = plan.next();
    ASSERT_TRUE(next.has_value());
    EXPECT_EQ(next->request.settings.exposure, 2);
    EXPECT_EQ(next->asked, kStart + 1s);
    EXPECT_FALSE(plan.repeats_final(*next));
}

TEST(DrawPlan, ReplacesAPlannedFrameWhenTheCameraMovesOn)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    plan.move_camera(pose_at(1), 1, /*cut=*/true, kStart);
    const Draw stale = *plan.next();
    EXPECT_FALSE(plan.newer_than(stale).has_value());
    EXPECT_TRUE(stale.request.reset_history);

    plan.move_camera(pose_at(2), 2, /*cut=*/false, kStart);
    const auto newer = plan.newer_than(stale);
    ASSERT_TRUE(newer.has_value());
    EXPECT_EQ(newer->camera_sequence, 2U);
    EXPECT_TRUE(newer->request.reset_history) << "the cut of the frame it replaces still counts";
    plan.plan_instead(*newer);
    EXPECT_FALSE(plan.newer_than(*newer).has_value());
    EXPECT_FALSE(plan.next()->request.reset_history);
}

TEST(DrawPlan, LockstepDrawsOneFrameForEachCameraInOrder)
{
    DrawPlan plan = make_plan(Mode::kLockstep, Format::kRaw);
    EXPECT_FALSE(plan.next().has_value());
    plan.move_camera(pose_at(1), 1, true, kStart);
    plan.move_camera(pose_at(1), 2, false, kStart);
    for (const std::uint32_t sequence : {1U, 2U}) {
        const auto draw = plan.next();
        ASSERT_TRUE(draw.has_value());
        EXPECT_EQ(draw->camera_sequence, sequence);
        EXPECT_EQ(draw->request.reset_history, sequence == 1);
        EXPECT_FALSE(draw->request.refine);
        EXPECT_EQ(draw->request.format, PixelFormat::kRgb32f);
    }
    EXPECT_FALSE(plan.next().has_value());
}

TEST(DrawPlan, LockstepAppliesChangesToTheCamerasSentAfterThem)
{
    DrawPlan plan = make_plan(Mode::kLockstep);
    plan.move_camera(pose_at(1), 1, false, kStart);
    plan.set_extent({32, 18}, kStart);
    plan.set_format(Format::kPng, kStart);
    plan.move_camera(pose_at(2), 2, false, kStart);

    const Draw before = *plan.next();
    EXPECT_EQ(before.request.extent, (Extent{64, 36}));
    EXPECT_EQ(before.format, Format::kJpeg420);
    EXPECT_EQ(before.session_epoch, 1U);
    const Draw after = *plan.next();
    EXPECT_EQ(after.request.extent, (Extent{32, 18}));
    EXPECT_EQ(after.format, Format::kPng);
    EXPECT_EQ(after.session_epoch, 2U);
}

TEST(DrawPlan, LockstepBoundsTheCamerasThatWait)
{
    DrawPlan plan = make_plan(Mode::kLockstep);
    for (std::uint32_t i = 1; i <= protocol::kLockstepQueue; ++i)
        EXPECT_TRUE(plan.move_camera(pose_at(i), i, false, kStart));
    EXPECT_FALSE(plan.move_camera(pose_at(0), 65, false, kStart));
    plan.next();
    EXPECT_TRUE(plan.move_camera(pose_at(0), 65, false, kStart));
}

TEST(RefuseExtent, AcceptsWhatTheDeviceAndMemoryAllow)
{
    EXPECT_FALSE(refuse_extent(1, 1, 4096));
    EXPECT_FALSE(refuse_extent(4096, 4096, 4096));
    EXPECT_TRUE(refuse_extent(0, 10, 4096));
    EXPECT_TRUE(refuse_extent(10, 0, 4096));
    EXPECT_TRUE(refuse_extent(4097, 1, 4096));
    EXPECT_TRUE(refuse_extent(4294967295U, 4294967295U, 1 << 30));
    EXPECT_EQ(refuse_extent(16384, 8192, 16384).value_or(""),
        "size is 16384x8192, expected 1x1 to 16384x16384 and at most 33177600 pixels");
}

RenderSettings settings_with(bool play, float time)
{
    RenderSettings settings;
    settings.play = play;
    settings.time = time;
    return settings;
}

TEST(DrawPlan, AMovingSceneNeverRestsWhileItPlays)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    plan.scene_moves(true);
    for (int i = 0; i < 10; ++i) {
        const auto draw = plan.next();
        ASSERT_TRUE(draw.has_value());
        EXPECT_FALSE(draw->request.refine);
        EXPECT_EQ(draw->request.clock_start, kStart);
    }
    plan.set_settings(settings_with(false, 0), kStart + 2s);
    plan.next();
    plan.next();
    const Draw paused = *plan.next();
    EXPECT_TRUE(paused.request.refine);
    EXPECT_DOUBLE_EQ(paused.request.time, 2);
    EXPECT_FALSE(paused.request.clock_start.has_value());
}

TEST(DrawPlan, TimeGoesOnWhereItStoppedAndJumpsWhereItIsSet)
{
    DrawPlan plan = make_plan(Mode::kInteractive);
    plan.set_settings(settings_with(false, 0), kStart + 3s);
    plan.set_settings(settings_with(true, 0), kStart + 10s);
    EXPECT_DOUBLE_EQ(plan.next()->request.time, 3);
    EXPECT_EQ(plan.next()->request.clock_start, kStart + 10s);
    plan.set_settings(settings_with(true, 0.5F), kStart + 11s);
    plan.go_to_time(kStart + 11s);
    EXPECT_DOUBLE_EQ(plan.next()->request.time, 0.5);
    plan.go_to_time(kStart + 13s);  // there once more
    const Draw again = *plan.next();
    EXPECT_DOUBLE_EQ(again.request.time, 0.5);
    EXPECT_EQ(again.request.clock_start, kStart + 13s);
}

TEST(DrawPlan, LockstepAdvancesByTheStepAndNotByTheClock)
{
    DrawPlan plan = make_plan(Mode::kLockstep);
    RenderSettings settings = settings_with(true, 1);
    settings.time_step = 0.25F;
    plan.set_settings(settings, kStart);
    plan.go_to_time(kStart);
    for (int i = 0; i < 3; ++i)
        plan.move_camera(pose_at(i), static_cast<std::uint32_t>(i + 1), false, kStart + i * 7s);
    settings.play = false;
    plan.set_settings(settings, kStart + 60s);
    plan.move_camera(pose_at(4), 4, false, kStart + 61s);
    plan.move_camera(pose_at(5), 5, false, kStart + 99s);
    for (const double expected : {1.0, 1.25, 1.5, 1.75, 1.75}) {
        const Draw draw = *plan.next();
        EXPECT_DOUBLE_EQ(draw.request.time, expected);
        EXPECT_FALSE(draw.request.clock_start.has_value());
        EXPECT_FALSE(draw.request.live);
    }
}

}  // namespace
}  // namespace farlight
