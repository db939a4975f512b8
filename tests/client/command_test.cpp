// The program itself: exit statuses, files and output, against the fake server.
#include "client/picture_file.h"
#include "tests/client/fake_server.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <sys/wait.h>

namespace farlight {
namespace {

using namespace client;
using testing::HasSubstr;

struct Outcome {
    int status;
    std::string out;
    std::string err;
};

class CommandTest : public testing::Test {
protected:
    CommandTest() { std::filesystem::create_directories(folder_); }
    ~CommandTest() override { std::filesystem::remove_all(folder_); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& text) const
    {
        std::ofstream(file(name)) << text;
        return file(name);
    }
    static std::string contents(const std::string& name)
    {
        std::ifstream stream(name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    Outcome farlight(const std::string& arguments) const
    {
        const std::string command = std::string(FARLIGHT_PROGRAM " ") + arguments + " >"
            + file("out") + " 2>" + file("err");
        const int status = std::system(command.c_str());
        return {WEXITSTATUS(status), contents(file("out")), contents(file("err"))};
    }

    FakeServer server{[](FakePeer& peer) { serve_lockstep(peer, {}); }};
    std::string url = " --url " + server.url_text() + " ";

private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir())
        / ("farlight_command_" + std::to_string(::getpid()));
};

TEST_F(CommandTest, WrongUseIsStatusTwo)
{
    for (const char* wrong : {"", "dance", "info", "info --url http://x", "record --url ws://x/ws",
             "info --url ws://x --scene y", "record --scene x --out y --frames 0",
             "record --scene x --out y --path a --orbit 3", "record --scene x --out y --format gif",
             "script", "script no_such_file.json", "info --url ws://x --size 3"})
        EXPECT_EQ(farlight(wrong).status, 2) << wrong;
    EXPECT_EQ(farlight("--help").status, 0);
    EXPECT_THAT(farlight("--version").out, HasSubstr("farlight " FARLIGHT_VERSION));
}

TEST_F(CommandTest, NobodyThereIsStatusOne)
{
    const Outcome outcome = farlight("info --url ws://127.0.0.1:1/ws");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.err, HasSubstr("127.0.0.1:1"));
    EXPECT_EQ(outcome.out, "");
}

TEST_F(CommandTest, InfoSaysWhatTheServerIs)
{
    const Outcome text = farlight("info" + url);
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("Fake (fake.json), 2 triangles, 1 lights"));
    EXPECT_THAT(text.out, HasSubstr("a note"));
    EXPECT_THAT(text.out, HasSubstr("same seed, same picture"));
    EXPECT_THAT(text.out, HasSubstr("fog: medium 'haze'"));
    EXPECT_THAT(text.out, HasSubstr("effect    denoising: setting denoiser = svgf\n"));
    EXPECT_THAT(text.out, HasSubstr("program   fog, denoising\n"));
    EXPECT_THAT(text.out, testing::Not(HasSubstr("not compiled yet")));
    EXPECT_THAT(text.out, HasSubstr("constants BVH_STACK_SIZE 9\n"));
    EXPECT_THAT(text.out, HasSubstr("bvh_nodes"));
    EXPECT_THAT(
        text.out, HasSubstr("textures  2 arrays with their mip levels, 100 of these bytes\n"));
    const Outcome hasty = farlight("info --wait 0" + url);
    EXPECT_THAT(hasty.out, HasSubstr("general programs; its own are not compiled yet\n"));
    EXPECT_THAT(hasty.out, HasSubstr("program   fog, denoising, lens\n"));
    const Outcome json = farlight("info --json" + url);
    EXPECT_EQ(nlohmann::json::parse(json.out)["scene"]["name"], "Fake");
    EXPECT_EQ(nlohmann::json::parse(json.out)["inspection"]["view_memory"][0]["bytes"], 2048);
}

TEST_F(CommandTest, BenchEffectsComparesTheProgramsAndLeavesEachEffectIn)
{
    const Outcome text = farlight("bench --effects --leave-one-in --frames 3" + url);
    EXPECT_THAT(text.out, HasSubstr("95 % interval"));
    EXPECT_THAT(text.out, HasSubstr("Fake with one effect more than it calls for\n"));
    EXPECT_THAT(text.out, HasSubstr("\nlens "));
    const Outcome json = farlight("bench --effects --json --frames 3" + url);
    EXPECT_EQ(json.status, 0) << json.err;
    const auto parsed = nlohmann::json::parse(json.out);
    EXPECT_EQ(parsed["scenes"][0]["effects"], "fog");
    EXPECT_EQ(parsed["scenes"][0]["general"]["view_bytes"], 2048);
    EXPECT_EQ(parsed["scenes"][0]["ratio"], 1.0);
    EXPECT_EQ(parsed["scenes"][0]["compile_ms"], 250);
}

TEST_F(CommandTest, RecordWritesNumberedFrames)
{
    const Outcome outcome = farlight(
        "record --orbit 20 --frames 3 --format pfm --json --size 8x4 --out " + file("r") + url);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(json["frames"].size(), 3U);
    EXPECT_EQ(json["frames"][2]["file"], "frame_00002.pfm");
    EXPECT_EQ(json["frames"][2]["trace_ms"], 1.5);
    EXPECT_EQ(json["frames"][2]["passes"][0]["name"], "path_trace");
    const Picture picture = read_picture(file("r") + "/frame_00002.pfm");
    EXPECT_EQ(picture.width, 8);
    EXPECT_NE(picture.linear, read_picture(file("r") + "/frame_00001.pfm").linear);
}

TEST_F(CommandTest, RecordPlaysAPathOfTheSceneOrAFileToItsEnd)
{
    EXPECT_EQ(farlight("record --path push --format exr --out " + file("p") + url).status, 0);
    EXPECT_TRUE(std::filesystem::exists(file("p") + "/frame_00004.exr"));
    EXPECT_FALSE(std::filesystem::exists(file("p") + "/frame_00005.exr"));
    const std::string path = write("path.json",
        R"([{"frame":0,"position":[0,0,3],"target":[0,0,0],"vertical_fov_degrees":40},
            {"frame":1,"position":[0,0,2],"target":[0,0,0],"vertical_fov_degrees":40}])");
    EXPECT_EQ(
        farlight("record --format exr --path " + path + " --out " + file("q") + url).status, 0);
    EXPECT_TRUE(std::filesystem::exists(file("q") + "/frame_00001.exr"));
    EXPECT_EQ(farlight("record --path no_such --out " + file("n") + url).status, 2);
}

TEST_F(CommandTest, ScriptJudgesAndWritesJunit)
{
    const std::string good =
        write("good.json", R"({"scene":"x","expect":["nonfinite == 0","not_black"]})");
    const std::string bad = write("bad.json", R"({"scene":"x","expect":["mean(run) > 50"]})");
    const Outcome passing = farlight("script " + good + url);
    EXPECT_EQ(passing.status, 0) << passing.err;
    EXPECT_EQ(passing.out, "ok  nonfinite == 0  (0)\nok  not_black  (yes)\n");
    const Outcome failing =
        farlight("script " + good + " " + bad + " --junit " + file("j.xml") + url);
    EXPECT_EQ(failing.status, 1);
    EXPECT_THAT(failing.out, HasSubstr("FAIL mean(run) > 50  ("));
    EXPECT_THAT(contents(file("j.xml")), HasSubstr("<failure message="));
    const Outcome json = farlight("script --json " + bad + url);
    EXPECT_EQ(nlohmann::json::parse(json.out)[0]["verdicts"][0]["ok"], false);
}

TEST_F(CommandTest, ABadScriptIsFoundBeforeAnythingIsPlayed)
{
    const std::string good = write("good.json", R"({"scene":"x","expect":["nonfinite == 0"]})");
    const std::string bad = write("bad.json", R"({"scene":"x","expect":["teapot == 0"]})");
    const Outcome outcome = farlight("script " + good + " " + bad + url);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("bad.json: /expect/0: found 'teapot == 0', column 1"));
}

TEST_F(CommandTest, BenchPrintsPassesAndLatency)
{
    const Outcome outcome = farlight("bench --json --frames 2 --moves 3" + url);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["sizes"][1]["size"], nlohmann::json({640, 360}));
    EXPECT_EQ(json["sizes"][0]["passes"][0]["median_ms"], 1.5);
    EXPECT_GT(json["latency"]["whole_median_ms"], 0);
}

TEST_F(CommandTest, BenchTakesTurnsWithTwoValuesOfASetting)
{
    const Outcome json = farlight("bench --json --frames 3 --turns exposure=1,2" + url);
    ASSERT_EQ(json.status, 0) << json.err;
    const auto parsed = nlohmann::json::parse(json.out);
    EXPECT_EQ(parsed["ratio"], 1.0);
    EXPECT_EQ(parsed["values"][1]["value"], "2");
    EXPECT_EQ(parsed["values"][1]["passes"][0]["median_ms"], 1.5);
    EXPECT_THAT(farlight("bench --frames 3 --turns exposure=1,2" + url).out,
        HasSubstr("2 / 1: 1.000 (1.000 to 1.000)"));
    const Outcome wrong = farlight("bench --turns exposure=1" + url);
    EXPECT_EQ(wrong.status, 2);
    EXPECT_THAT(wrong.err, HasSubstr("--turns exposure=1: expected KEY=A,B"));
}

}  // namespace
}  // namespace farlight
