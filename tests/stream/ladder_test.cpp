// What rungs cost and bring: the fit, the cost model, errors, candidates and their frontier.
#include "server/stream/ladder.h"

#include "server/stream/cost_model.h"
#include "server/stream/recursive_fit.h"
#include "server/stream/rung_errors.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace farlight {
namespace {

/// 200 observations with 5 % noise leave a standard error near 1 % in each of two coefficients;
/// five of those.
TEST(RecursiveFit, RecoversPlantedCoefficients)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> regressor(0.2, 4);
    std::normal_distribution<double> noise(1, 0.05);
    RecursiveFit<2> fit({1, 1}, {10, 10}, 1000);
    for (int i = 0; i < 200; ++i) {
        const double x = regressor(random);
        const double value = (3 + 7 * x) * noise(random);
        fit.add({1, x}, value, 0.05 * value);
    }
    EXPECT_NEAR(fit.coefficients()[0], 3, 5 * 0.03);
    EXPECT_NEAR(fit.coefficients()[1], 7, 5 * 0.07);
}

TEST(RecursiveFit, ForgetsWhatIsNoLongerSo)
{
    RecursiveFit<2> fit({0, 0}, {10, 10}, 15);
    const auto observe = [&](double a, double b) {
        for (int i = 0; i < 120; ++i) {
            const double x = 1 + i % 4;
            fit.add({1, x}, a + b * x, 0.1);
        }
    };
    observe(2, 5);
    observe(4, 1);
    EXPECT_NEAR(fit.coefficients()[0], 4, 0.05);
    EXPECT_NEAR(fit.coefficients()[1], 1, 0.05);
}

/// Equal observations say nothing of the difference between two coefficients: whatever a thousand
/// of them were, the next other one is not taken for more than it is.
TEST(RecursiveFit, EqualObservationsDoNotLetDoubtGrow)
{
    RecursiveFit<2> fit({5, 5}, {5, 5}, 15);
    for (int i = 0; i < 1000; ++i)
        fit.add({1, 1}, 10, 1);
    fit.add({1, 2}, 15.5, 1);
    EXPECT_NEAR(fit.coefficients()[0] + fit.coefficients()[1], 10, 0.5);
    EXPECT_NEAR(fit.coefficients()[1], 5, 1);
}

TEST(CostModel, LearnsPartsFromChangesOfChoice)
{
    // The model's own form: trace 2 + 50 px (n + 0.3), denoise 1 + 8 px (levels + 1.5).
    const auto trace = [](double px, const Choice& c) {
        return 2 + 50 * px * (c.samples_per_pixel + 0.3);
    };
    const auto denoise = [](double px, const Choice& c) {
        return 1 + 8 * px * (c.atrous_iterations + 1.5);
    };
    CostModel model;
    EXPECT_FALSE(model.knows());
    EXPECT_EQ(model.ms(1, Choice()), 0);
    for (int i = 0; i < 30; ++i)
        for (const Choice& choice : {Choice{0.5F, 1, 5}, Choice{1, 1, 3}, Choice{1, 4, 5}}) {
            const double px = choice.resolution_scale == 1 ? 1 : 0.25;
            model.add_frame(1, choice, trace(px, choice), denoise(px, choice));
        }
    const Choice unseen{1, 16, 1};
    EXPECT_NEAR(model.ms(1, unseen) / (trace(1, unseen) + denoise(1, unseen)), 1, 0.01);
    EXPECT_NEAR(model.ms(4, Choice()) / (trace(4, Choice()) + denoise(4, Choice())), 1, 0.02);

    model.follow_load(1, Choice(), 2 * trace(1, Choice()), denoise(1, Choice()), 1);
    EXPECT_NEAR(model.ms(1, unseen) / (2 * trace(1, unseen) + denoise(1, unseen)), 1, 0.01);
}

TEST(RungErrors, ScalesWhatWasNotDrawnFromWhatWas)
{
    RungErrors record;
    const std::vector<Choice> choices{{0.5F, 1, 5}, {1, 1, 5}, {1, 2, 5}, {1, 4, 5}, {1, 4, 6}};
    EXPECT_FALSE(record.errors_of(choices)[0]);
    record.add({1, 1, 5}, {0.04, 0.03, 0.05});
    record.add({1, 4, 5}, {0.02, 0.01, 0.03});
    record.add({1, 1, 5}, {std::numeric_limits<double>::quiet_NaN()});
    const auto errors = record.errors_of(choices);
    EXPECT_NEAR(errors[0]->value, 0.16, 1e-12);
    EXPECT_EQ(errors[1]->value, 0.04);
    EXPECT_EQ(errors[1]->upper, 0.05);
    EXPECT_NEAR(errors[2]->value, std::sqrt(0.04 * 0.02), 1e-12);  // half-way in the logarithms
    EXPECT_TRUE(std::isnan(errors[2]->upper));
    EXPECT_EQ(errors[3]->value, 0.02);
    EXPECT_NEAR(errors[4]->value, 0.01, 1e-12);
}

/// What the filter blurs stays when samples are added; in fewer pixels all of it weighs more.
TEST(RungErrors, OnlyNoiseIsLessenedBySamples)
{
    RungErrors record;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    record.add({1, 1, 5}, {0.010, nan, nan, 0.004});
    const auto errors = record.errors_of({{1, 4, 5}, {1, 1, 4}, {0.5F, 1, 5}});
    EXPECT_NEAR(errors[0]->value, 0.006 + 0.001, 1e-12);
    EXPECT_NEAR(errors[1]->value, 0.006 + 0.008, 1e-12);
    EXPECT_NEAR(errors[2]->value, 0.040, 1e-12);
}

TEST(RungErrors, TheNewerOfTwoThatContradictHolds)
{
    RungErrors record;
    record.add({1, 1, 5}, {0.01});
    record.add({1, 4, 5}, {0.02});  // the camera looks elsewhere
    const auto errors = record.errors_of({{1, 1, 5}, {1, 4, 5}});
    EXPECT_NEAR(errors[0]->value, 0.08, 1e-12);
    EXPECT_EQ(errors[1]->value, 0.02);
}

TEST(RungErrors, ForgetsWhatIsOld)
{
    RungErrors record;
    record.add({1, 1, 5}, {0.04});
    for (std::uint64_t i = 0; i <= RungErrors::kMemory; ++i)
        record.add({1, 4, 5}, {0.02});
    EXPECT_NEAR(record.errors_of({{1, 1, 5}})[0]->value, 0.08, 1e-12);
}

/// Estimates are of the pixels drawn: what stands for the error of a smaller picture has the order
/// of strength, and no interval.
TEST(RungErrors, OfSmallerPicturesNothingIsMeasured)
{
    RungErrors record;
    record.add({0.5F, 1, 5}, {0.01, 0.008, 0.012});
    const auto smaller = record.errors_of({{0.5F, 1, 5}})[0];
    EXPECT_NEAR(smaller->value, 0.04, 1e-12);
    EXPECT_TRUE(std::isnan(smaller->lower));
    EXPECT_TRUE(std::isnan(smaller->upper));
    EXPECT_NEAR(record.errors_of({{1, 1, 5}})[0]->value, 0.01, 1e-12);
}

TEST(Ladder, CandidatesGrowStepByStep)
{
    RenderSettings wishes;
    const std::vector<Choice> choices = candidate_choices(wishes, 1000);
    EXPECT_EQ(choices.front(), (Choice{0.25F, 1, 1}));
    EXPECT_EQ(choices.back(), (Choice{1, 64, 5}));
    for (std::size_t i = 1; i < choices.size(); ++i)
        EXPECT_GT(strength_of(choices[i]), strength_of(choices[i - 1]));
    for (std::size_t i = 3; i < choices.size(); ++i)
        EXPECT_LE(strength_of(choices[i]), 2 * strength_of(choices[i - 1]));
}

TEST(Ladder, CandidatesKeepToWishesAndLimits)
{
    RenderSettings wishes;
    wishes.resolution_scale = 0.5F;
    wishes.atrous_iterations = 2;
    std::vector<Choice> choices = candidate_choices(wishes, 5);
    EXPECT_EQ(choices.front(), (Choice{0.25F, 1, 2}));
    EXPECT_EQ(choices.back(), (Choice{0.5F, 4, 2}));
    EXPECT_EQ(candidate_choices(wishes, 0).back(), (Choice{0.5F, 1, 2}));
    wishes.denoiser = Denoiser::kOff;
    wishes.atrous_iterations = 5;
    EXPECT_EQ(candidate_choices(wishes, 5).front(), (Choice{0.25F, 1, 5}));
}

TEST(Ladder, AFrontierHoldsNoDominatedRung)
{
    std::mt19937 random(2);
    std::uniform_int_distribution<int> grid(1, 6);  // so that some are equal
    for (int round = 0; round < 200; ++round) {
        std::vector<Rung> rungs;
        rungs.reserve(12);
        for (int i = 0; i < 12; ++i)
            rungs.push_back({{1, i + 1, 5}, "", 1.0 * grid(random), RungError{1.0 * grid(random)}});
        const std::vector<Rung> frontier = frontier_of(rungs);
        ASSERT_FALSE(frontier.empty());
        for (std::size_t i = 1; i < frontier.size(); ++i) {
            EXPECT_GT(frontier[i].ms, frontier[i - 1].ms);
            EXPECT_LT(frontier[i].error->value, frontier[i - 1].error->value);
        }
        for (const Rung& rung : rungs)  // each has one as good and as cheap on the frontier
            EXPECT_TRUE(std::any_of(frontier.begin(), frontier.end(), [&](const Rung& other) {
                return other.ms <= rung.ms && other.error->value <= rung.error->value;
            }));
    }
}

TEST(Ladder, LabelsSayWhatIsUnusual)
{
    EXPECT_EQ(label_of({1, 1, 5}, {}), "1 sample");
    EXPECT_EQ(label_of({0.35F, 4, 5}, {}), "35 % size, 4 samples");
    EXPECT_EQ(label_of({0.25F, 1, 1}, {}), "25 % size, 1 sample, a-trous 1");
}

}  // namespace
}  // namespace farlight
