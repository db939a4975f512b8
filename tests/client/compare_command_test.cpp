// farlight compare: numbers, files and exit statuses.
#include "client/picture_file.h"
#include "tests/client/synthetic_pictures.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace farlight {
namespace {

using namespace client;
using testing::HasSubstr;
using testing::Not;

struct CompareOutcome {
    int status;
    std::string out;
    std::string err;
};

class CompareCommandTest : public testing::Test {
protected:
    CompareCommandTest()
    {
        for (const char* name : {"a", "b"})
            std::filesystem::create_directories(folder_ / name);
    }
    ~CompareCommandTest() override { std::filesystem::remove_all(folder_); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    /// Linear 32x16, every value times `scale`.
    std::string light(const std::string& name, double scale, ImageSize size = {32, 16}) const
    {
        write_picture(file(name),
            {.width = size.width,
                .height = size.height,
                .linear = synthetic_picture(
                    [&](int x, int y, int c) { return scale * synthetic_light(x, y, c); }, size),
                .display = {}});
        return file(name);
    }
    std::string shown(const std::string& name, int added) const
    {
        std::vector<std::uint8_t> bytes;
        for (const float value : synthetic_picture(synthetic_scene, {32, 16}))
            bytes.push_back(
                static_cast<std::uint8_t>(std::min(static_cast<int>(value) + added, 255)));
        write_picture(file(name), {.width = 32, .height = 16, .linear = {}, .display = bytes});
        return file(name);
    }
    CompareOutcome compare(const std::string& arguments) const
    {
        const std::string command = std::string(FARLIGHT_PROGRAM " compare ") + arguments + " >"
            + file("out") + " 2>" + file("err");
        const int status = std::system(command.c_str());
        const auto text = [&](const char* name) {
            std::ifstream stream(file(name));
            return std::string{std::istreambuf_iterator<char>(stream), {}};
        };
        return {WEXITSTATUS(status), text("out"), text("err")};
    }

private:
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir())
        / ("farlight_compare_" + std::to_string(::getpid()));
};

TEST_F(CompareCommandTest, PrintsEveryMetricWithItsFormula)
{
    const CompareOutcome text = compare(light("x.exr", 1.5) + " " + light("r.pfm", 1));
    EXPECT_EQ(text.status, 0) << text.err;
    for (const char* name : {"relmse", "relmse999", "mse", "rmse", "psnr", "smape", "ssim", "flip",
             "hdr_flip", "fireflies"})
        EXPECT_THAT(text.out, HasSubstr(std::string("\n") + name + " "));
    EXPECT_THAT(text.out, HasSubstr("mean((x - r)^2 / (r^2 + 0.01))\n"));
    EXPECT_THAT(text.out, HasSubstr("32x16, x and r linear radiance"));
    EXPECT_THAT(text.out, HasSubstr("weighted median"));
}

TEST_F(CompareCommandTest, JsonHoldsValuesAndTheTableOfMetrics)
{
    const CompareOutcome outcome =
        compare("--json " + light("x.exr", 1.5) + " " + light("r.exr", 1));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    const auto x = synthetic_picture(
        [](int i, int j, int c) { return 1.5 * synthetic_light(i, j, c); }, {32, 16});
    const auto r = synthetic_picture(synthetic_light, {32, 16});
    EXPECT_EQ(json["files"][0]["values"]["relmse"], relative_mse(x, r));
    EXPECT_EQ(json["mean"]["smape"], smape(x, r));
    EXPECT_EQ(json["kind"], "linear");
    EXPECT_EQ(json["metrics"][0]["name"], "relmse");
    EXPECT_EQ(json["metrics"][4]["better"], "higher");
    EXPECT_EQ(json["sequence"], nullptr);
    EXPECT_GT(json["files"][0]["hdr_flip"]["third_quartile"], 0);
}

TEST_F(CompareCommandTest, DisplayValuesAreDecodedAndThatIsSaid)
{
    const CompareOutcome text = compare(shown("x.png", 10) + " " + shown("r.png", 0));
    EXPECT_EQ(text.status, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("decoded from sRGB"));
    EXPECT_THAT(text.out, Not(HasSubstr("hdr_flip")));
    EXPECT_EQ(compare("--exposure 2 " + file("x.png") + " " + file("r.png")).status, 2);
    const CompareOutcome mixed = compare(file("x.png") + " " + light("r.exr", 1));
    EXPECT_EQ(mixed.status, 2);
    EXPECT_THAT(mixed.err, HasSubstr("r.exr (32x16, linear radiance), expected one size"));
}

TEST_F(CompareCommandTest, ExposureAndCurveChangeWhatIsSeenOnly)
{
    const std::string pair = light("x.exr", 1.5) + " " + light("r.exr", 1);
    const auto values = [&](const std::string& options) {
        return nlohmann::json::parse(compare("--json " + options + pair).out)["mean"];
    };
    const auto plain = values("");
    for (const char* options :
        {"--exposure 0.1 ", "--tonemap linear ", "--pixels-per-degree 30 "}) {
        EXPECT_EQ(values(options)["relmse"], plain["relmse"]) << options;
        EXPECT_NE(values(options)["flip"], plain["flip"]) << options;
    }
}

/// The upper half counts not at all: neither its error nor its pixels.
TEST_F(CompareCommandTest, AMaskLeavesPixelsOut)
{
    const auto half = [&](const char* name, double upper, double lower) {
        write_picture(file(name),
            {.width = 32,
                .height = 16,
                .linear = synthetic_picture(
                    [&](int, int y, int) { return y < 8 ? upper : lower; }, {32, 16}),
                .display = {}});
        return file(name);
    };
    const std::string pair = half("x.exr", 9, 1.5) + " " + half("r.exr", 1, 1);
    const auto masked = nlohmann::json::parse(
        compare("--json --mask " + half("depth.exr", 0, 5) + " " + pair).out)["mean"];
    EXPECT_NEAR(masked["relmse"].get<double>(), 0.25 / 1.01, 1e-12);
    EXPECT_EQ(masked["fireflies"], 0);
    EXPECT_EQ(compare("--mask " + light("small.exr", 1, {16, 16}) + " " + pair).status, 1);
    EXPECT_EQ(compare("--mask " + file("none.exr") + " " + pair).status, 2);
}

TEST_F(CompareCommandTest, FoldersAreMatchedByName)
{
    for (const int i : {0, 1, 2}) {
        const std::string name = "/frame_" + std::to_string(i) + ".exr";
        light("a" + name, i == 1 ? 1.25 : 1);
        light("b" + name, 1);
    }
    const std::string folders = file("a") + " " + file("b");
    const auto json = nlohmann::json::parse(compare("--json " + folders).out);
    EXPECT_EQ(json["files"].size(), 3U);
    EXPECT_EQ(json["files"][0]["values"]["relmse"], 0);
    EXPECT_GT(json["files"][1]["values"]["relmse"], 0);
    EXPECT_NEAR(json["mean"]["relmse"].get<double>(),
        json["files"][1]["values"]["relmse"].get<double>() / 3, 1e-12);
    EXPECT_GT(json["sequence"]["values"]["flicker"], 0);
    EXPECT_THAT(compare(folders).out, HasSubstr("\nmean over 3 files\n"));
    EXPECT_EQ(compare("--heat-map " + file("h.png") + " " + folders).status, 2);

    light("a/alone.exr", 1);
    const CompareOutcome unmatched = compare(folders);
    EXPECT_EQ(unmatched.status, 2);
    EXPECT_THAT(unmatched.err, HasSubstr("/b: lacks alone.exr"));
    EXPECT_EQ(compare(file("a") + " " + file("b/frame_0.exr")).status, 2);
}

TEST_F(CompareCommandTest, BoundsThatDoNotHoldAreStatusOne)
{
    const std::string pair = light("x.exr", 1.5) + " " + light("r.exr", 1);
    EXPECT_EQ(compare("--max relmse=0.5 --max flip=0.9 --min ssim=0.1 " + pair).status, 0);
    const CompareOutcome exceeded = compare("--max relmse=0.5 --max flip=0.001 " + pair);
    EXPECT_EQ(exceeded.status, 1);
    EXPECT_THAT(exceeded.err, HasSubstr("x.exr: flip is 0."));
    EXPECT_THAT(exceeded.err, HasSubstr("expected at most 0.001"));
    EXPECT_THAT(compare("--max relmse=2.5e-9 " + pair).err, HasSubstr("expected at most 2.5e-09"));
    EXPECT_EQ(compare("--min psnr=90 " + pair).status, 1);
    EXPECT_EQ(compare("--max beauty=1 " + pair).status, 2);
    EXPECT_EQ(compare("--max relmse " + pair).status, 2);
    EXPECT_EQ(compare("--max relmse=much " + pair).status, 2);
    EXPECT_EQ(compare("--max flicker=1 " + pair).status, 2);  // one frame has none
}

TEST_F(CompareCommandTest, HeatMapsAreWritten)
{
    const std::string pair = light("x.exr", 1.5) + " " + light("r.exr", 1);
    std::vector<std::vector<std::uint8_t>> maps;
    for (const char* heat : {"flip", "absolute", "signed"}) {
        ASSERT_EQ(
            compare("--heat-map " + file("h.png") + " --heat " + heat + " " + pair).status, 0);
        maps.push_back(read_picture(file("h.png")).display);
        EXPECT_EQ(maps.back().size(), 32U * 16 * 3);
    }
    EXPECT_NE(maps[0], maps[1]);
    EXPECT_NE(maps[1], maps[2]);
}

TEST_F(CompareCommandTest, WhatCannotBeComparedIsSaid)
{
    const std::string r = light("r.exr", 1);
    EXPECT_EQ(compare(r).status, 2);
    const CompareOutcome sizes = compare(light("small.exr", 1, {16, 16}) + " " + r);
    EXPECT_EQ(sizes.status, 2);
    EXPECT_THAT(sizes.err, HasSubstr("small.exr (16x16, linear radiance)"));
    const CompareOutcome missing = compare(file("none.exr") + " " + r);
    EXPECT_EQ(missing.status, 2);
    EXPECT_THAT(missing.err, HasSubstr("none.exr"));
    EXPECT_EQ(compare(file("a") + " " + file("b")).status, 2);

    Picture bad{.width = 32,
        .height = 16,
        .linear = synthetic_picture(synthetic_light, {32, 16}),
        .display = {}};
    bad.linear[40] = std::numeric_limits<float>::quiet_NaN();
    write_picture(file("bad.pfm"), bad);
    const CompareOutcome nan = compare(file("bad.pfm") + " " + r);
    EXPECT_EQ(nan.status, 1);
    EXPECT_THAT(nan.err, HasSubstr("bad.pfm: 1 of 1536 values of the picture are not finite"));
    EXPECT_EQ(nan.out, "");
}

}  // namespace
}  // namespace farlight
