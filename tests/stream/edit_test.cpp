// Live edits over real sockets: who is told what, and that a bad edit hurts nobody.
#include "tests/stream/server_under_test.h"
#include "tests/stream/session_bench.h"
#include "tests/stream/test_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farlight {
namespace {

using nlohmann::json;
using protocol::Edit;
using protocol::Error;
using protocol::ErrorCode;
using protocol::SceneChanged;

TEST(EditTest, AllSessionsHearOfItAndItsAuthorByItsId)
{
    ServerUnderTest server;
    TestClient author(server.port());
    TestClient other(server.port());
    author.hello(lockstep());
    other.hello(lockstep());
    author.say(Edit{.id = 7, .patch = {{"name", "night"}}});
    const auto told = author.next<SceneChanged>();
    EXPECT_EQ(told.edit, 7U);
    EXPECT_EQ(told.scene.name, "night");
    EXPECT_EQ(other.next<SceneChanged>().edit, std::nullopt);
    TestClient later(server.port());
    EXPECT_EQ(later.hello(lockstep()).scene.name, "night");
}

TEST(EditTest, FramesAfterItHaveTheNextEpoch)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(interactive());
    const std::uint32_t before = client.next_frame().header.session_epoch;
    client.say(Edit{.id = 1, .patch = {{"name", "night"}}});
    client.acknowledge(1);
    std::uint32_t epoch = before;
    while (epoch == before) {
        const ReceivedFrame frame = client.next_frame();
        epoch = frame.header.session_epoch;
        client.acknowledge(frame.header.frame_id);
    }
    EXPECT_EQ(epoch, before + 1);
}

TEST(EditTest, ABadOneIsRefusedWithItsPlaceAndTheServerGoesOn)
{
    ServerUnderTest server;
    TestClient author(server.port());
    TestClient other(server.port());
    author.hello(lockstep());
    other.hello(lockstep());
    author.say(Edit{.id = 1, .patch = {{"bad", 1}}});
    const auto refused = author.next<Error>();
    EXPECT_EQ(refused.code, ErrorCode::kEditRefused);
    EXPECT_EQ(refused.field, "/bad");
    EXPECT_FALSE(refused.fatal);
    author.say(Edit{.id = 2, .patch = {{"name", "day"}}});
    EXPECT_EQ(author.next<SceneChanged>().edit, 2U);
    EXPECT_EQ(other.next<SceneChanged>().scene.name, "day") << "the bad one was told to nobody";
}

TEST(EditTest, ResetForgetsEarlierEdits)
{
    ServerUnderTest server;
    TestClient client(server.port());
    const std::string name = client.hello(lockstep()).scene.name;
    client.say(Edit{.id = 1, .patch = {{"name", "night"}}});
    EXPECT_EQ(client.next<SceneChanged>().scene.name, "night");
    client.say(Edit{.id = 2, .patch = json::object(), .reset = true});
    EXPECT_EQ(client.next<SceneChanged>().scene.name, name);
}

TEST(EditTest, AServerMayTakeNone)
{
    StreamOptions options;
    options.edits = false;
    ServerUnderTest server(options);
    TestClient client(server.port());
    EXPECT_FALSE(client.hello(lockstep()).edits);
    client.say(Edit{.id = 1, .patch = {{"name", "night"}}});
    EXPECT_EQ(client.next<Error>().code, ErrorCode::kEditRefused);
    EXPECT_EQ(server.renderer().description()->scene_name, "gradient");
}

TEST(EditTest, AnAuthorWhoLeavesLeavesTheRestServed)
{
    ServerUnderTest server;
    TestClient other(server.port());
    other.hello(lockstep());
    {
        TestClient author(server.port());
        author.hello(lockstep());
        author.say(Edit{.id = 1, .patch = {{"name", "night"}}});
    }
    EXPECT_EQ(other.next<SceneChanged>().scene.name, "night");
}

TEST(EditTest, ManyAtOnceAreMadeInOrderOrRefused)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    constexpr std::uint32_t kEdits = 60;
    for (std::uint32_t i = 1; i <= kEdits; ++i)
        client.say(Edit{.id = i, .patch = {{"name", std::to_string(i)}}});
    std::uint32_t last = 0;
    for (std::uint32_t answers = 0; answers < kEdits; ++answers) {
        const Received received = client.receive();
        const auto& message = std::get<protocol::ServerMessage>(received);
        if (const auto* changed = std::get_if<SceneChanged>(&message)) {
            EXPECT_GT(changed->edit.value_or(0), last);
            last = changed->edit.value_or(0);
        } else {
            EXPECT_EQ(std::get<Error>(message).code, ErrorCode::kEditRefused);
        }
    }
    EXPECT_GT(last, 0U);
}

TEST(InspectTest, TellsWhatTheSceneCallsForAndWhatDrewTheLastFrame)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    client.say(protocol::Inspect{});
    const auto before = client.next<protocol::Inspection>();
    EXPECT_EQ(before.effects.size(), 1U);
    EXPECT_EQ(before.effects[0].name, "fog");
    EXPECT_TRUE(before.passes.empty());
    client.say(protocol::Camera{.sequence = 1, .pose = {}});
    client.next_frame();
    client.say(protocol::Inspect{});
    const auto after = client.next<protocol::Inspection>();
    EXPECT_THAT(after.effects,
        testing::ElementsAre(before.effects[0],
            protocol::CalledEffect{"denoising", "setting denoiser = svgf", "denoiser"}));
    EXPECT_THAT(after.program, testing::ElementsAre("fog", "denoising"));
    EXPECT_THAT(
        after.constants, testing::ElementsAre(protocol::ProgramConstant{"BVH_STACK_SIZE", 9}));
    EXPECT_FALSE(after.general);
}

TEST(EffectsSettingTest, LessThanTheSceneNeedsIsRefusedWithTheReason)
{
    ServerUnderTest server;
    TestClient client(server.port());
    client.hello(lockstep());
    client.say(protocol::Set{"effects", "lens,textures"});
    const auto refused = client.next<Error>();
    EXPECT_EQ(refused.code, ErrorCode::kBadSetting);
    EXPECT_THAT(
        refused.message, testing::HasSubstr("'fog' is missing: medium 'haze', sigma_t 0.02 1/m"));
    client.say(protocol::Set{"effects", "fog, lens"});
    EXPECT_EQ(client.next<protocol::State>().settings.at("effects"), "fog,lens");
    client.say(protocol::Set{"effects", "fgo"});
    EXPECT_THAT(client.next<Error>().message, testing::HasSubstr("found \"fgo\""));
}

}  // namespace
}  // namespace farlight
