// From sums over tiles to what is said of a picture's error, and which frames have such sums.
#include "server/render/error_schedule.h"

#include "server/render/error_estimate.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace farlight {
namespace {

/// Sums over the tiles of a picture whose pixels are drawn from an exponential distribution, as
/// squares of noise nearly are; the true mean is 1.
std::vector<glm::vec4> random_tiles(Extent extent, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::exponential_distribution<float> draw(1);
    const Extent tiles = tiles_of(extent);
    std::vector<glm::vec4> sums;
    for (int y = 0; y < tiles.height; ++y)
        for (int x = 0; x < tiles.width; ++x) {
            const int pixels = std::min(kTileSize, extent.width - x * kTileSize)
                * std::min(kTileSize, extent.height - y * kTileSize);
            glm::vec4 sum(0);
            for (int i = 0; i < pixels; ++i)
                sum += glm::vec4(draw(random), 0, draw(random), 1);
            sums.push_back(sum);
        }
    return sums;
}

TEST(MeanOfTiles, WeighsPixelsEqually)
{
    const Extent extent{9, 8};  // a whole tile and a column of 8 pixels
    const std::vector<glm::vec4> sums{{6, 0, 12, 3}, {0, 0, 0, 0}};
    EXPECT_DOUBLE_EQ(mean_of_tiles(sums, extent, 0).value, 2);
    EXPECT_DOUBLE_EQ(mean_of_tiles(sums, extent, 2).value, 4);
    EXPECT_FALSE(mean_of_tiles(sums, {8, 8}, 0).deviation >= 0) << "one tile has no spread";
}

/// Of 200 seeded pictures of independent pixels; intervals that are right leave the band of 90 to
/// 98 % in 1 of 100 runs.
TEST(MeanOfTiles, IntervalsCoverTheTruth)
{
    int covered = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const Extent extent{250, 190};
        const ErrorEstimate mean = mean_of_tiles(random_tiles(extent, seed), extent, 0);
        covered += mean.lower <= 1 && 1 <= mean.upper ? 1 : 0;
    }
    EXPECT_GE(covered, 180);
    EXPECT_LE(covered, 196);
}

TEST(ErrorRecord, KnowsNothingWithoutSums)
{
    const FrameErrors errors = ErrorRecord().add({.extent = {16, 16}});
    EXPECT_FALSE(errors.predicted.known());
    EXPECT_FALSE(errors.measured.known());
    EXPECT_EQ(errors.reference_samples, 0U);
    EXPECT_TRUE(std::isnan(errors.effective_samples));
}

/// A picture of 30 frames' mean, whose frames are off by 0.6 each, weighs 0.75 in what is shown.
TEST(ErrorRecord, BlendsTheErrorsOfDenoisedPictureAndMean)
{
    const std::vector<glm::vec4> measured(4, glm::vec4(64 * 0.04F, 0, 64 * 0.02F, 64));
    const std::vector<glm::vec4> predicted(4, glm::vec4(64 * 0.01F, 64 * 0.5F, 0, 64));
    const FrameErrors errors = ErrorRecord().add({.predicted = predicted,
        .denoised = true,
        .measured = measured,
        .extent = {16, 16},
        .samples_per_pixel = 2,
        .mean_frames = 30,
        .mean_weight = 0.75,
        .reference_frames = 20});
    EXPECT_NEAR(errors.measured.value, 0.04, 1e-8);
    EXPECT_EQ(errors.reference_samples, 40U);
    EXPECT_NEAR(errors.raw, 0.6, 1e-6);
    EXPECT_NEAR(errors.predicted.value, 0.0625 * 0.04 + 0.5625 * 0.02, 1e-8);
    EXPECT_NEAR(errors.noise, 0.0625 * 0.01 + 0.5625 * 0.02, 1e-8);
    EXPECT_NEAR(errors.effective_samples, 2 * 0.6 / (0.0625 * 0.04 + 0.5625 * 0.02), 1e-4);
}

TEST(ErrorRecord, ForgetsWhatItKnewOfAnotherPicture)
{
    ErrorRecord record;
    const auto add_pair = [&](float half_picture, bool starts_anew) {
        const std::vector<glm::vec4> first(100, glm::vec4(0, 6.4F, 0, 64));
        const std::vector<glm::vec4> second(100, glm::vec4(0, 0, 64 * half_picture, 64));
        record.add(
            {.starts_anew = starts_anew, .predicted = first, .denoised = true, .extent = {80, 80}});
        return record.add(
            {.predicted = second, .second_of_pair = true, .denoised = true, .extent = {80, 80}});
    };
    FrameErrors errors;
    for (int i = 0; i < 10; ++i)
        errors = add_pair(0.5F, false);
    EXPECT_NEAR(errors.predicted.value, 0.5, 1e-6);
    EXPECT_NEAR(errors.raw, 0.1, 1e-6);
    errors = add_pair(0.1F, false);
    EXPECT_GT(errors.predicted.value, 0.4) << "a single pair weighs little";
    errors = add_pair(0.1F, true);
    EXPECT_NEAR(errors.predicted.value, 0.1, 1e-6);
}

TEST(ErrorRecord, KeepsWhatItKnowsBetweenPairs)
{
    const std::vector<glm::vec4> first(4, glm::vec4(0.64F, 6.4F, 0, 64));
    ErrorRecord record;
    record.add({.predicted = first, .denoised = true, .extent = {16, 16}});
    const FrameErrors errors = record.add({.denoised = true, .extent = {16, 16}});
    EXPECT_NEAR(errors.noise, 0.01, 1e-6);
    EXPECT_NEAR(errors.raw, 0.1, 1e-6);
    const FrameErrors plain = record.add({.extent = {16, 16}});
    EXPECT_TRUE(std::isnan(plain.noise)) << "of a picture that is not denoised nothing is known";
}

/// A camera that turns to the sky and back.
TEST(ErrorRecord, KnowsNothingOfAPictureInWhichNothingCounts)
{
    const std::vector<glm::vec4> first(4, glm::vec4(0.64F, 6.4F, 0, 64));
    const std::vector<glm::vec4> second(4, glm::vec4(0, 0, 3.2F, 64));
    const std::vector<glm::vec4> sky(4, glm::vec4(0));
    ErrorRecord record;
    const auto add = [&](const std::vector<glm::vec4>& sums, bool second_of_pair) {
        return record.add({.predicted = sums,
            .second_of_pair = second_of_pair,
            .denoised = true,
            .extent = {16, 16}});
    };
    add(first, false);
    EXPECT_NEAR(add(second, true).predicted.value, 0.04, 1e-6);
    EXPECT_FALSE(add(sky, false).predicted.known());
    EXPECT_FALSE(add(second, true).predicted.known()) << "noise is not known";
    add(first, false);
    EXPECT_NEAR(add(second, true).predicted.value, 0.04, 1e-6);
}

/// Looks of frames `first` to `last`, P: first of a pair, p: second, -: neither.
std::string looks_of(ErrorSchedule& schedule, int first, int last, bool new_filter = false)
{
    std::string text;
    FramePlan plan;
    for (int i = first; i <= last; ++i) {
        plan.frame_index = static_cast<std::uint32_t>(i);
        const ErrorLooks looks = schedule.next(plan, new_filter && i == first, false);
        EXPECT_TRUE(looks.predicts || !looks.second_of_pair);
        text += !looks.predicts ? '-' : looks.second_of_pair ? 'p' : 'P';
    }
    return text;
}

TEST(ErrorSchedule, PairsFollowEachOtherWhileHistoriesGrowAndThenLeaveGaps)
{
    ErrorSchedule schedule;
    EXPECT_EQ(looks_of(schedule, 0, 23), "PpPpPpPpPpPpPpPpPp--Pp--");
    EXPECT_EQ(looks_of(schedule, 0, 3), "PpPp") << "a cut begins anew";
}

TEST(ErrorSchedule, AnotherFilterLeavesAPairUnfinished)
{
    ErrorSchedule schedule;
    EXPECT_EQ(looks_of(schedule, 0, 20), "PpPpPpPpPpPpPpPpPp--P");
    EXPECT_EQ(looks_of(schedule, 21, 40, true), "-PpPpPpPpPpPpPpPp--P");
}

/// By default a picture is final after 256 samples.
TEST(ErrorSchedule, APictureIsMeasuredBeforeItIsFinal)
{
    for (const bool specular : {false, true}) {
        ErrorSchedule schedule;
        FramePlan plan;
        plan.refine = true;
        int measured_at = 0;
        for (plan.mean_frames = 1; plan.mean_frames <= 256 && measured_at == 0; ++plan.mean_frames)
            if (schedule.next(plan, false, specular).measured_against > 0)
                measured_at = plan.mean_frames;
        EXPECT_EQ(measured_at, specular ? 64 + 135 : 31 + 31);
    }
}

TEST(ErrorSchedule, PredictsOnlyWhatIsDenoised)
{
    FramePlan plan;
    plan.settings.denoiser = Denoiser::kOff;
    EXPECT_FALSE(ErrorSchedule().next(plan, false, false).predicts);
    plan.settings = {};
    plan.settings.error_estimate = false;
    EXPECT_FALSE(ErrorSchedule().next(plan, false, false).predicts);
}

TEST(FramesToForget, LeaveAThousandth)
{
    EXPECT_EQ(frames_to_forget(1), 1);
    for (const double alpha : {0.5, 0.2, 0.05, 1.0 / 32}) {
        EXPECT_LE(std::pow(1 - alpha, frames_to_forget(alpha)), 1e-3);
        EXPECT_GT(std::pow(1 - alpha, frames_to_forget(alpha) - 1), 1e-3);
    }
}

}  // namespace
}  // namespace farlight
