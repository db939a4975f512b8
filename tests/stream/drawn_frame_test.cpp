// When a resting picture is final, and what a header tells of bad values.
#include "server/stream/drawn_frame.h"

#include "tests/protocol/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

namespace farlight {
namespace {

/// The `frames`-th frame at rest of 3 samples each, and an error of 0.01 up to `upper`.
bool final_after(int frames, double upper, double target)
{
    Draw draw;
    draw.request.settings.samples_per_pixel = 3;
    draw.request.settings.target_error = static_cast<float>(target);
    RenderedFrame frame;
    frame.accumulated_samples = static_cast<std::uint32_t>(3 * frames);
    frame.errors.predicted.value = 0.01;
    frame.errors.predicted.upper = upper;
    return is_final(frame, draw);
}

TEST(DrawnFrame, IsFinalWhereTheWholeIntervalReachesTheTarget)
{
    EXPECT_TRUE(final_after(8, 0.02, 0.025));
    EXPECT_FALSE(final_after(8, 0.03, 0.025)) << "the value alone may be luck";
    EXPECT_FALSE(final_after(8, std::numeric_limits<double>::quiet_NaN(), 0.025));
    EXPECT_FALSE(final_after(7, 0.02, 0.025)) << "too few frames to believe it";
    EXPECT_FALSE(final_after(8, 0.02, 0)) << "no target";
}

TEST(DrawnFrame, IsFinalWithTheSamplesAskedFor)
{
    RenderedFrame frame;
    EXPECT_FALSE(is_final(frame, Draw()));
    frame.converged = true;
    EXPECT_TRUE(is_final(frame, Draw()));
}

RenderedFrame frame_that_met(std::uint32_t stage, BadKind kind, std::uint32_t pixels)
{
    RenderedFrame frame;
    frame.bad_values.counts()[stage * KIND_COUNT + static_cast<std::size_t>(kind)] = pixels;
    return frame;
}

TEST(DrawnFrame, TellsBadValuesByStageAndKind)
{
    RenderedFrame frame = frame_that_met(STAGE_ATROUS_1 + 2, BadKind::kInfinite, 5);
    frame.bad_values.add(frame_that_met(STAGE_ATROUS_1 + 2, BadKind::kNan, 2).bad_values);
    frame.bad_values.add(frame_that_met(STAGE_HIT, BadKind::kNegative, 3).bad_values);
    frame.bad_values.add(frame_that_met(STAGE_TONEMAP, BadKind::kClamped, 4).bad_values);
    const protocol::FrameHeader header = task_for(std::move(frame), Draw(), {}, false).header;
    EXPECT_EQ(header.nonfinite_count, 7U);
    EXPECT_EQ(header.negative_count, 3U);
    EXPECT_EQ(header.clamped_count, 4U);
    EXPECT_THAT(header.stages,
        testing::ElementsAre(protocol::StageEntry{"hit", 0, 0, 3, 0},
            protocol::StageEntry{"atrous_3", 2, 5, 0, 0},
            protocol::StageEntry{"tonemap", 0, 0, 0, 4}));
    EXPECT_TRUE(task_for(RenderedFrame(), Draw(), {}, false).header.stages.empty());
}

TEST(DrawnFrame, KindsAndStagesAreThoseOfThePage)
{
    std::vector<std::string_view> kinds;
    const protocol::StageEntry none;
    protocol::StageEntry::each_count(
        none, [&](auto, std::string_view kind) { kinds.push_back(kind); });
    ASSERT_EQ(kinds.size(), kBadKinds.size());
    for (const BadKindRow& row : kBadKinds)
        EXPECT_EQ(kinds[static_cast<std::size_t>(row.kind)], row.name);

    std::vector<std::pair<std::string, std::string>> documented;
    std::vector<std::pair<std::string, std::string>> known;
    const ProtocolDocument page = read_protocol_document();
    for (const auto& cells : page.tables.at("5"))
        if (cells.size() == 2 && cells[0].starts_with('`'))
            documented.emplace_back(cells[0], cells[1]);
    for (const CountedStage& stage : kCountedStages)
        known.emplace_back("`" + std::string(stage.name) + "`", stage.looks_at);
    EXPECT_EQ(documented, known);
}

}  // namespace
}  // namespace farlight
