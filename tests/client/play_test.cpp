// Scripts played against the fake renderer: verdicts that must come out one way or the other.
#include "client/script/judge.h"
#include "tests/client/fake_server.h"

#include <gmock/gmock.h>

namespace farlight {
namespace {

using namespace client;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<std::string> lines_for(const std::string& json, const FakeRenderer& renderer)
{
    const Script script = parse_script(JsonInput(nlohmann::json::parse(json), "s.json"));
    FakeServer server([&](FakePeer& peer) { serve_lockstep(peer, renderer); });
    const Played played = play(script, server.url(), [](const std::string&) {});
    std::vector<std::string> lines;
    for (const Verdict& verdict : judge(script, played))
        lines.push_back(to_line(verdict));
    return lines;
}

TEST(Play, VerdictsShowWhatWasFound)
{
    // The fake's error is exactly 1 (none) to 1/100 (svgf) before the reference's own noise.
    const auto lines = lines_for(R"json({"scene":"a","size":[32,16],"frames":3,
        "runs":{"svgf":{"denoiser":"svgf"},"none":{"denoiser":"none"}},"reference":{"samples":4096},
        "events":[{"frame":1,"cut":true},{"frame":2,"set":{"samples_per_pixel":4}}],
        "expect":["nonfinite == 0","relmse(svgf) <= 0.02 * relmse(none)","relmse(svgf) <= 0.005 * relmse(none)",
            "frames(svgf) == 3","history_resets(none) == 2","samples(none, 0) == 1","samples(none) == 4",
            "same_bytes_twice","not_black","max(none) > 2"]})json",
        {});
    ASSERT_EQ(lines.size(), 10U);
    EXPECT_EQ(lines[0], "ok  nonfinite == 0  (0)");
    EXPECT_THAT(lines[1],
        testing::MatchesRegex(
            "ok  relmse.svgf. <= 0.02 . relmse.none.  .0.00[0-9]+ <= 0.00[0-9]+."));
    EXPECT_THAT(lines[2], HasSubstr("FAIL relmse(svgf) <= 0.005 * relmse(none)  (0.0"));
    EXPECT_EQ(lines[3], "ok  frames(svgf) == 3  (3)");
    EXPECT_EQ(lines[4], "ok  history_resets(none) == 2  (2)");
    EXPECT_EQ(lines[5], "ok  samples(none, 0) == 1  (1)");
    EXPECT_EQ(lines[6], "ok  samples(none) == 4  (4)");
    EXPECT_EQ(lines[7], "ok  same_bytes_twice  (yes)");
    EXPECT_EQ(lines[8], "ok  not_black  (yes)");
    EXPECT_THAT(lines[9], HasSubstr("FAIL max(none) > 2  (1."));
}

/// The fake's noise: uniform in [0, 2], so of variance 1/3; svgf's a hundredth of it.
TEST(Play, EveryMetricCanBeExpected)
{
    const auto lines = lines_for(R"json({"scene":"a","size":[32,16],"frames":4,
        "runs":{"a":{"denoiser":"svgf","seed":1},"b":{"denoiser":"svgf","seed":2},"c":{"denoiser":"none","seed":3}},
        "reference":{"samples":4096},
        "expect":["relmse999(a) <= 1.0001 * relmse(a)","rmse(a) * rmse(a) - mse(a) < 1e-12","psnr(a) > psnr(c)",
            "smape(a) < smape(c)","ssim(a) > ssim(c)","flip(a) < flip(c)","hdr_flip(a) < hdr_flip(c)",
            "fireflies(c) == 0","flicker(c) > 9 * flicker(a, 1)","difference(a) < 0.2 * difference(c)",
            "lag(a) == 0","lag(c, 1) <= 1","ghost(a) <= 0.12","ghost(a) > 0","ghost(c) > 0.2",
            "bias < 0.02","variance > 0.08","flip(c, 0) != flip(c)"]})json",
        {});
    ASSERT_EQ(lines.size(), 18U);
    for (const std::string& line : lines)
        EXPECT_THAT(line, testing::StartsWith("ok  "));
}

TEST(Play, FramesThatAreNotFiniteHaveNoFlicker)
{
    EXPECT_THAT(
        lines_for(
            R"({"scene":"a","frames":4,"expect":["flicker(run) >= 0","flicker(run, 2) >= 0"]})",
            {.nan_in_frame = 1}),
        ElementsAre("FAIL flicker(run) >= 0  (1 values of the frames are not finite)",
            testing::StartsWith("ok  flicker(run, 2) >= 0")));
}

TEST(Play, BytesThatDifferAreSeen)
{
    EXPECT_THAT(lines_for(R"({"scene":"a","frames":2,"expect":["same_bytes_twice"]})",
                    {.ignores_seed = true}),
        ElementsAre("FAIL same_bytes_twice  (no)"));
}

TEST(Play, OneNanInOneFrameIsCountedAndStopsComparisons)
{
    const std::string script = R"({"scene":"a","frames":3,"reference":{"samples":1},
        "expect":["nonfinite == 0","nonfinite(run) == 1","mean(run, 1) > 0","rmse(run) < 9"]})";
    EXPECT_THAT(lines_for(script, {.nan_in_frame = 1}),
        ElementsAre("FAIL nonfinite == 0  (1)", "ok  nonfinite(run) == 1  (1)",
            "FAIL mean(run, 1) > 0  (1 of 384 values of the picture are not finite)",
            HasSubstr("ok  rmse(run) < 9")));
}

TEST(Play, ARefusedSettingIsTheScriptsFault)
{
    EXPECT_THAT(
        [] {
            lines_for(R"({"scene":"a","runs":{"x":{"sharpness":1}},"expect":["nonfinite == 0"]})",
                {.refuses_setting = "sharpness"});
        },
        ThrowsMessage<InputError>(
            HasSubstr("s.json: /runs/x: the server refuses: setting 'sharpness' is unknown")));
}

TEST(Play, AReferenceShortOfSamplesIsNoReference)
{
    const auto stingy = [](FakePeer& peer) {
        peer.read();
        peer.send(fake_welcome());
        for (std::uint32_t sequence = 0;;) {
            const auto message = peer.read();
            if (std::holds_alternative<protocol::Set>(message))
                peer.send(protocol::State{});
            if (std::holds_alternative<protocol::Camera>(message))
                peer.send_frame({.format = protocol::Format::kRaw,
                                    .camera_sequence = ++sequence,
                                    .width = 1,
                                    .height = 1},
                    std::vector<std::byte>(12));
            if (std::holds_alternative<protocol::ClientBye>(message))
                return peer.close(1000, "");
        }
    };
    FakeServer server(stingy);
    const Script script = parse_script(
        JsonInput(nlohmann::json::parse(
                      R"({"scene":"a","reference":{"samples":8},"expect":["rmse(run) < 9"]})"),
            "s.json"));
    EXPECT_THAT([&] { play(script, server.url(), [](const std::string&) {}); },
        ThrowsMessage<SessionError>(HasSubstr("the reference has 0 samples a pixel, expected 8")));
}

TEST(Junit, CountsAndEscapes)
{
    const std::string xml = junit_xml({{.file = "a.json",
        .seconds = 1.5,
        .verdicts = {{"mean(a) < 1", true, "0.5"}, {"max(a) < \"1\" & 2", false, "3 > 2"}}}});
    EXPECT_THAT(xml, HasSubstr(R"(<testsuite name="a.json" tests="2" failures="1" time="1.5">)"));
    EXPECT_THAT(xml, HasSubstr(R"(<testcase classname="a.json" name="mean(a) &lt; 1"/>)"));
    EXPECT_THAT(xml,
        HasSubstr(
            R"(name="max(a) &lt; &quot;1&quot; &amp; 2"><failure message="3 &gt; 2"/></testcase>)"));
}

}  // namespace
}  // namespace farlight
