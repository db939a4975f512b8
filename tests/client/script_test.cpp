// Script files: the page's example reads, and errors name the place.
#include "client/script/script.h"

#include <fstream>
#include <gmock/gmock.h>
#include <iterator>

namespace farlight {
namespace {

using namespace client;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::string page()
{
    std::ifstream file(FARLIGHT_SOURCE_DIR "/client/cli/SCRIPT.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

Script script_of(const std::string& json)
{
    return parse_script(JsonInput(nlohmann::json::parse(json), "dir/s.json"));
}

TEST(Script, ThePagesExampleReads)
{
    const std::string text = page();
    const std::string fence = "```json script\n";
    const auto start = text.find(fence) + fence.size();
    const Script script = script_of(text.substr(start, text.find("```", start) - start));
    EXPECT_EQ(script.scene, "dir/night_room.json");
    EXPECT_EQ(script.size, (protocol::Size{320, 180}));
    EXPECT_EQ(script.frames, 31);
    EXPECT_EQ(std::get<OrbitMove>(script.camera).from, -30);
    EXPECT_EQ(script.settings.at("max_depth"), 5);
    ASSERT_EQ(script.events.size(), 2U);
    EXPECT_EQ(script.events[0].set.at("sigma_luminance"), 2);
    EXPECT_TRUE(script.events[1].cut);
    EXPECT_EQ(script.runs.at("none").at("denoiser"), "none");
    EXPECT_EQ(script.reference->samples, 4096);
    EXPECT_EQ(script.expectations.size(), 4U);
}

TEST(Script, ThePageListsEveryFunction)
{
    const std::string text = page();
    for (const Function& function : kFunctions) {
        const std::string row = "| `" + std::string(function.name) + "` | "
            + std::string(to_string(function.of)) + " | " + std::string(function.meaning) + " |";
        EXPECT_THAT(text, HasSubstr(row));
    }
}

TEST(Script, WhatIsAbsentHasADefault)
{
    const Script script = script_of(R"({"scene":"a.json","expect":["nonfinite == 0"]})");
    EXPECT_EQ(script.frames, 1);
    EXPECT_TRUE(std::holds_alternative<RestMove>(script.camera));
    EXPECT_EQ(script.runs.size(), 1U);
    EXPECT_TRUE(script.runs.contains("run"));
    EXPECT_FALSE(script.size || script.reference);
}

TEST(Script, CamerasPoseByFrame)
{
    protocol::Welcome welcome;
    welcome.camera = {.position = {0, 0, 4}, .target = {0, 0, 0}};
    welcome.scene.bounds = protocol::BoundingBox{{-1, -1, -1}, {1, 1, 1}};
    welcome.camera_paths["p"] = {{.frame = 0, .pose = {.position = {8, 0, 0}}}};
    const auto pose = [&](const std::string& camera, int frame) {
        return pose_of(script_of(R"({"scene":"a","frames":3,"expect":["nonfinite == 0"],"camera":)"
                           + camera + "}"),
            welcome, frame);
    };
    EXPECT_EQ(pose("\"rest\"", 2), welcome.camera);
    EXPECT_NEAR(pose(R"({"orbit":{"degrees":180,"from":-90}})", 0).position[0], -4, 1e-12);
    EXPECT_EQ(pose(R"({"orbit":{"degrees":180,"from":-90}})", 1), welcome.camera);
    EXPECT_NEAR(pose(R"({"orbit":{"degrees":180,"from":-90}})", 2).position[0], 4, 1e-12);
    EXPECT_EQ(pose(R"({"path":"p"})", 1).position[0], 8);
    EXPECT_EQ(
        pose(
            R"({"keyframes":[{"frame":0,"position":[7,0,0],"target":[0,0,0],"vertical_fov_degrees":9}]})",
            1)
            .position[0],
        7);
    EXPECT_THAT([&] { pose(R"({"path":"q"})", 0); },
        ThrowsMessage<InputError>(
            HasSubstr("dir/s.json: /camera/path: found 'q', expected a camera path")));
}

struct BadScript {
    const char* name;
    std::string fields;  ///< Added to a script that is otherwise right.
    const char* complaint;
};
class ParseScriptRefuses : public testing::TestWithParam<BadScript> { };

TEST_P(ParseScriptRefuses, NamingThePlace)
{
    auto json = nlohmann::json::parse(
        R"({"scene":"a.json","frames":4,"runs":{"a":{}},"expect":["nonfinite == 0"]})");
    json.update(nlohmann::json::parse(GetParam().fields));
    EXPECT_THAT([&] { script_of(json.dump()); },
        ThrowsMessage<InputError>(HasSubstr(GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(Scripts, ParseScriptRefuses,
    testing::Values(BadScript{"UnknownKey", R"({"sene":"b"})",
                        "dir/s.json: /: found unknown key 'sene', expected one of"},
        BadScript{"SceneType", R"({"scene":1})", "/scene: found 1, expected a string"},
        BadScript{"Size", R"({"size":[0,9]})",
            "/size/0: found 0, expected a whole number from 1 to 65535"},
        BadScript{"SizeCount", R"({"size":[1,2,3]})",
            "/size: found [1,2,3], expected an array of width and height"},
        BadScript{"Frames", R"({"frames":1.5})", "/frames: found 1.5, expected a whole number"},
        BadScript{"Camera", R"({"camera":"spin"})",
            "/camera: found \"spin\", expected \"rest\" or an object"},
        BadScript{"CameraKind", R"({"camera":{"spin":1}})", "/camera: found unknown key 'spin'"},
        BadScript{
            "TwoCameras", R"({"camera":{"path":"p","orbit":{"degrees":1}}})", "/camera: found {"},
        BadScript{"Orbit", R"({"camera":{"orbit":{}}})", "/camera/orbit: found no key 'degrees'"},
        BadScript{"Keyframes", R"({"camera":{"keyframes":[]}})", "/camera/keyframes: found []"},
        BadScript{"Setting", R"({"settings":{"seed":[1]}})",
            "/settings/seed: found [1], expected a string, number or boolean"},
        BadScript{"EventFrame", R"({"events":[{"frame":4,"cut":true}]})",
            "/events/0/frame: found 4, expected a whole number from 0 to 3"},
        BadScript{"EventOrder", R"({"events":[{"frame":2,"cut":true},{"frame":1,"cut":true}]})",
            "/events/1/frame: found 1, expected events in the order"},
        BadScript{"EventEmpty", R"({"events":[{"frame":2}]})",
            "/events/0: found an event that does nothing"},
        BadScript{"NoRuns", R"({"runs":{}})", "/runs: found {}, expected at least one run"},
        BadScript{
            "RunName", R"({"runs":{"a b":{}}})", "found the run name 'a b', expected letters"},
        BadScript{"Samples", R"({"reference":{"samples":0}})", "/reference/samples: found 0"},
        BadScript{"NoExpectations", R"({"expect":[]})",
            "/expect: found [], expected at least one expectation"},
        BadScript{"Expectation", R"({"expect":["mean(a) =< 1"]})",
            "/expect/0: found 'mean(a) =< 1', column 9"},
        BadScript{"UnknownRun", R"({"expect":["mean(b) < 1"]})",
            "/expect/0: found the unknown run 'b', expected one of /runs"},
        BadScript{"FrameBeyond", R"({"expect":["mean(a, 4) < 1"]})",
            "/expect/0: found frame 4, expected 0 to 3"},
        BadScript{
            "FrameNegative", R"({"expect":["mean(a, -1) < 1"]})", "/expect/0: found frame -1"},
        BadScript{
            "NoReference", R"({"expect":["relmse(a) < 1"]})", "found 'relmse' but no /reference"},
        BadScript{"ReferenceElsewhere",
            R"({"reference":{"samples":9},"camera":{"orbit":{"degrees":9}},"expect":["relmse(a, 1) < 1"]})",
            "found 'relmse' of a frame before the last with a moving camera"},
        BadScript{"LagElsewhere",
            R"({"reference":{"samples":9},"camera":{"orbit":{"degrees":9}},"expect":["lag(a, 1) < 1"]})",
            "found 'lag' of a frame before the last with a moving camera"},
        BadScript{"FlickerOfOne", R"({"expect":["flicker(a, 3) < 1"]})",
            "found 'flicker' of one frame, expected 2 frames or more"},
        BadScript{"GhostOfOne",
            R"({"frames":1,"reference":{"samples":9},"expect":["ghost(a) < 1"]})",
            "found 'ghost' of one frame"},
        BadScript{"BiasOfOne", R"({"reference":{"samples":9},"expect":["bias < 1"]})",
            "found 'bias' of one run, expected 2 runs or more"}),
    [](const auto& tested) { return tested.param.name; });

TEST(ReadScript, FilesThatAreNotJsonNameLineAndColumn)
{
    const std::filesystem::path file = std::filesystem::path(testing::TempDir())
        / ("script_" + std::to_string(::getpid()) + ".json");
    std::ofstream(file) << "{\n  \"scene\": \"a\",\n  frames: 2\n}\n";
    EXPECT_THAT(
        [&] { read_script(file); }, ThrowsMessage<InputError>(HasSubstr(".json:3:4: is not JSON")));
    std::ofstream(file) << R"({"frames": 1e999})";
    EXPECT_THAT([&] { read_script(file); }, ThrowsMessage<InputError>(HasSubstr("not finite")));
    std::filesystem::remove(file);
    EXPECT_THAT([&] { read_script(file); }, ThrowsMessage<InputError>(HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace farlight
