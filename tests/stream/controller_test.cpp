// The controller on scripted loads: how often it steps, how soon it has settled, what it misses.
#include "tests/stream/scripted_device.h"

#include <cmath>
#include <gtest/gtest.h>

namespace farlight {
namespace {

RenderSettings budget_of(double ms, double error = 0)
{
    RenderSettings wishes;
    wishes.budget_ms = static_cast<float>(ms);
    wishes.target_error = static_cast<float>(error);
    return wishes;
}

struct Trace {
    DeviceSpeed speed;
    double budget_ms;
};

/// Budgets that each device can keep with some rung of 640x360, but not with all.
class OnDevices : public testing::TestWithParam<Trace> {
protected:
    OnDevices() : device(GetParam().speed, budget_of(GetParam().budget_ms)) { }

    double budget() const { return GetParam().budget_ms; }

    ScriptedDevice device;
};

TEST_P(OnDevices, SettlesInTenFramesAndStays)
{
    device.draw_for(30);
    EXPECT_LE(frames_until_settled(device.frames, 0, 30), 10);
    EXPECT_LE(missed(device.frames, budget()), 0.02);
    EXPECT_LE(device.frames.back().ms, budget());
}

/// The rung above the one settled on would not leave a fifth of the budget free.
TEST_P(OnDevices, UsesTheBudget)
{
    device.draw_for(30);
    const std::size_t above = *device.controller.current() + 1;
    ASSERT_LT(above, device.controller.ladder().size());
    ScriptedDevice dearer(
        GetParam().speed, with_choice(budget_of(0), device.controller.ladder()[above].choice));
    dearer.draw_for(1);
    EXPECT_GT(dearer.frames.back().ms, 0.75 * budget());
}

TEST_P(OnDevices, AHeavierLoadIsMetInTenFrames)
{
    device.draw_for(20, [](double t) { return t < 10 ? 1 : 1.9; });
    EXPECT_LE(frames_until_settled(device.frames, 10, 20), 10);
    EXPECT_LE(missed(device.frames, budget()), 0.02);
    EXPECT_LE(device.frames.back().ms, budget());
}

TEST_P(OnDevices, ALighterLoadIsUsedWithOneStepASecond)
{
    device.draw_for(30, [](double t) { return t < 10 ? 1 : 0.4; });
    EXPECT_LE(most_steps_in_a_second(device.frames, 10, 30), 1);
    EXPECT_LE(missed(device.frames, budget()), 0.02);
    EXPECT_GT(device.frames.back().ms, 0.4 * budget());
}

/// Back to where it was, or one rung short of it where that one leaves less than a fifth free.
TEST_P(OnDevices, ASpikeIsOverSoon)
{
    device.draw_for(10);
    const double before = strength_of(device.frames.back().choice);
    device.draw_for(15, [](double t) { return t < 10.05 ? 8 : 1; });
    EXPECT_GE(strength_of(device.frames.back().choice), 0.65 * before);
    EXPECT_LE(most_steps_in_a_second(device.frames, 11, 25), 1);
    EXPECT_LE(missed(device.frames, budget()), 0.02);
}

/// Twenty loads of a minute each; at most one step a second in each, and six in all.
TEST_P(OnDevices, TimesThatScatterByAFifthMoveLittle)
{
    for (unsigned seed = 1; seed <= 20; ++seed) {
        ScriptedDevice noisy(GetParam().speed, budget_of(budget()));
        noisy.set_scatter(0.2, seed);
        noisy.draw_for(60);
        EXPECT_LE(most_steps_in_a_second(noisy.frames, noisy.frames[11].seconds, 60), 1) << seed;
        EXPECT_LE(missed(noisy.frames, budget()), 0.02) << seed;
        EXPECT_LE(noisy.controller.steps(), 6U) << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Traces, OnDevices,
    testing::Values(Trace{kSoftware, 60}, Trace{kSoftware, 150}, Trace{kSmallGpu, 10},
        Trace{kSmallGpu, 33}, Trace{kLargeGpu, 4}, Trace{kLargeGpu, 16}),
    [](const auto& parameter) {
        return parameter.param.speed.name
            + std::to_string(static_cast<int>(parameter.param.budget_ms)) + "ms";
    });

const Rung& rung_of(const ScriptedDevice& device)
{
    return device.controller.ladder()[*device.controller.current()];
}

TEST(Controller, AnImpossibleBudgetDrawsTheCheapestRung)
{
    ScriptedDevice device(kSoftware, budget_of(1));
    device.draw_for(20);
    EXPECT_EQ(device.controller.current(), 0U);
    EXPECT_LE(frames_until_settled(device.frames, 0, 20), 10);
    EXPECT_EQ(missed(device.frames, 1), 1);
}

TEST(Controller, ASlowDeviceKeepsToTheOnlyRungThatFits)
{
    ScriptedDevice device(kSoftware, budget_of(10));
    device.draw_for(20);
    EXPECT_EQ(device.controller.current(), 0U);
    EXPECT_LE(frames_until_settled(device.frames, 0, 20), 10);
    EXPECT_LE(missed(device.frames, 10), 0.02);
}

TEST(Controller, MovesAlongAFrontierAndChangesNothingElse)
{
    ScriptedDevice device(kSmallGpu, budget_of(20));
    device.set_noise(0.01);
    device.set_scatter(0.2, 3);
    for (int second = 0; second < 30; ++second) {
        device.draw_for(1, [](double t) { return 1 + 0.8 * std::sin(t); });
        const std::vector<Rung>& ladder = device.controller.ladder();
        for (std::size_t i = 1; i < ladder.size(); ++i) {
            EXPECT_GT(ladder[i].ms, ladder[i - 1].ms);
            EXPECT_LT(ladder[i].error->value, ladder[i - 1].error->value);
        }
        const RenderSettings settings = device.controller.settings(false);
        EXPECT_EQ(choice_of(settings), rung_of(device).choice);
        EXPECT_EQ(settings, with_choice(budget_of(20), choice_of(settings)));
    }
    EXPECT_GT(device.controller.steps(), 5U);
}

TEST(Controller, LeavesSettingsAloneWithoutABudget)
{
    RenderSettings wishes;
    wishes.samples_per_pixel = 3;
    ScriptedDevice device(kSoftware, wishes);
    device.draw_for(3);
    EXPECT_EQ(device.controller.current(), std::nullopt);
    EXPECT_EQ(device.controller.settings(false), wishes);
    EXPECT_EQ(device.controller.settings(true), wishes);
}

TEST(Controller, KnowsFromFramesWithoutABudgetWhatKeepsANewOne)
{
    ScriptedDevice device(kSoftware, RenderSettings());
    device.draw_for(2);
    EXPECT_GT(device.frames.back().ms, 200);
    device.wish(budget_of(100));
    const std::size_t before = device.frames.size();
    device.draw_for(10);
    for (std::size_t i = before + 1; i < device.frames.size(); ++i)  // one was asked for already
        EXPECT_LE(device.frames[i].ms, 100) << i;
}

TEST(Controller, ALargerPictureIsScaledFor)
{
    ScriptedDevice device(kSmallGpu, budget_of(20));
    device.draw_for(5);
    device.wish(budget_of(20), {1280, 720});
    const std::size_t before = device.frames.size();
    device.draw_for(10);
    for (std::size_t i = before + 1; i < device.frames.size(); ++i)
        EXPECT_LE(device.frames[i].ms, 20) << i;
}

TEST(Controller, ATargetErrorIsMetAsCheaplyAsItCan)
{
    ScriptedDevice device(kLargeGpu, budget_of(0, 0.01 / 3.5));
    device.set_noise(0.01);
    device.draw_for(20);
    EXPECT_EQ(device.frames.back().choice, (Choice{1, 4, 5}));
    EXPECT_LE(frames_until_settled(device.frames, 0, 20), 10);
    EXPECT_GT(device.controller.ladder().back().ms, device.frames.back().ms);
}

TEST(Controller, ATargetErrorThatEasesOffIsMetMoreCheaply)
{
    ScriptedDevice device(kLargeGpu, budget_of(0, 0.01 / 3.5));
    device.set_noise(0.01);
    device.draw_for(5);
    device.set_noise(0.002);
    device.draw_for(10);
    EXPECT_LT(strength_of(device.frames.back().choice), strength_of({1, 2, 5}));
    EXPECT_LE(most_steps_in_a_second(device.frames, 5, 15), 1);
}

/// Smaller pictures would reach it by what is learnt of the pixels they draw.
TEST(Controller, ATargetErrorIsMetAtFullSizeOnly)
{
    ScriptedDevice device(kLargeGpu, budget_of(0, 5));
    device.set_noise(0.01);
    device.draw_for(10);
    EXPECT_LE(device.controller.ladder().front().error->value, 5);
    EXPECT_EQ(device.frames.back().choice, (Choice{1, 1, 5}));
}

TEST(Controller, OfBothBudgetsTheTimeWins)
{
    ScriptedDevice device(kSmallGpu, budget_of(20, 0.01 / 64));
    device.set_noise(0.01);
    device.draw_for(20);
    EXPECT_LE(device.frames.back().ms, 20);
    EXPECT_LE(missed(device.frames, 20), 0.02);
    EXPECT_GT(device.controller.ladder()[*device.controller.current()].error->value, 0.01 / 64);
    device.wish(budget_of(20, 0.05));
    device.draw_for(10);
    EXPECT_LT(device.frames.back().ms, 16);  // a cheaper rung is good enough
}

TEST(Controller, ATargetErrorMeansNothingUntilErrorsAreKnown)
{
    ScriptedDevice device(kSmallGpu, budget_of(0, 1e-4));
    device.draw_for(5);
    EXPECT_EQ(device.frames.back().choice, Choice());
    EXPECT_EQ(device.controller.steps(), 0U);
}

TEST(Controller, RestingPicturesKeepTheirSettingsButForSamples)
{
    RenderSettings wishes = budget_of(20);
    wishes.samples_per_pixel = 16;
    ScriptedDevice device(kSmallGpu, wishes);
    device.draw_for(5);
    const RenderSettings resting = device.controller.settings(true);
    EXPECT_EQ(resting.resolution_scale, 1);
    EXPECT_EQ(resting.atrous_iterations, wishes.atrous_iterations);
    EXPECT_EQ(resting.samples_per_pixel, 2);  // 17 ms; 3 take 22
    // A mean that has begun is not begun anew, whatever frames under way still tell.
    device.draw_for(1, [](double) { return 3; });
    const Choice rested = choice_of(device.controller.settings(true));
    EXPECT_EQ(rested.samples_per_pixel, 1);
    device.controller.drawn({rested, 500, 500}, Controller::Time(std::chrono::seconds(7)));
    EXPECT_EQ(choice_of(device.controller.settings(true)), rested);
}

TEST(Controller, TellsItsFrontierWhenItIsKnownBetterAndOnceASecond)
{
    Controller controller;
    controller.follow(RenderSettings(), {640, 360});
    const auto at = [](double seconds) {
        return Controller::Time(std::chrono::milliseconds(std::llround(seconds * 1000)));
    };
    const auto draw = [&](double seconds, double ms, double error) {
        controller.drawn(
            {Choice(), ms / 2, ms / 2, {error, 0.9 * error, 1.1 * error}}, at(seconds));
        return controller.news(at(seconds));
    };
    EXPECT_FALSE(draw(0, 50, 0.01)) << "a first frame tells nothing";
    const auto first = draw(0.1, 50, 0.01);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->source, protocol::FrontierSource::kLearnt);
    const std::uint16_t own = controller.rung_of(Choice());
    ASSERT_GT(own, 1);
    const protocol::FrontierPoint& drawn = first->points.at(own - 1U);
    EXPECT_EQ(drawn.label, "1 sample");
    EXPECT_EQ(drawn.settings.at("samples_per_pixel"), 1);
    EXPECT_NEAR(drawn.ms, 50, 1e-9);
    EXPECT_EQ(drawn.error, 0.01);
    EXPECT_EQ(drawn.upper, 1.1 * 0.01);
    const protocol::FrontierPoint& scaled = first->points.at(own);
    EXPECT_EQ(scaled.label, "2 samples");
    EXPECT_EQ(scaled.error, 0.005);
    EXPECT_FALSE(scaled.upper) << "not drawn, so not estimated";
    EXPECT_EQ(controller.rung_of({0.77F, 1, 5}), 0);

    EXPECT_FALSE(draw(0.2, 500, 0.1)) << "within a second";
    EXPECT_TRUE(draw(1.2, 500, 0.1));
    EXPECT_TRUE(draw(2.2, 500, 0.1)) << "the means have moved on";
    for (int i = 0; i < 40; ++i)
        draw(2.3 + 0.1 * i, 500, 0.1);
    EXPECT_FALSE(draw(9, 500, 0.1)) << "nothing new";
    EXPECT_FALSE(draw(9.3, 50, 0.1)) << "looked for within a second";
    EXPECT_TRUE(draw(10.1, 50, 0.1));
    EXPECT_EQ(controller.steps(), 0U) << "it does not steer";
}

TEST(Controller, AnotherSceneIsLearntAnew)
{
    ScriptedDevice device(kSmallGpu, budget_of(20));
    device.set_noise(0.01);
    device.draw_for(5);
    device.controller.change_scene();
    EXPECT_FALSE(device.controller.ladder().front().error);
    device.draw_for(10, [](double) { return 5; });
    EXPECT_LE(frames_until_settled(device.frames, 5, 15), 10);
    EXPECT_LE(device.frames.back().ms, 20);
}

}  // namespace
}  // namespace farlight
