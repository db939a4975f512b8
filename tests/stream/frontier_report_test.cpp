// Reports of `farlight accuracy` as the server reads them, and what a controller makes of them.
#include "server/stream/frontier_report.h"

#include "server/scene/scene_file.h"
#include "tests/stream/scripted_device.h"

#include <gtest/gtest.h>

namespace farlight {
namespace {

using nlohmann::json;

json sound_report()
{
    return json::parse(R"({
      "scene": {"name": "Box", "file": "box.json", "triangles": 38, "lights": 1},
      "device": "software", "gl_renderer": "llvmpipe", "size": [640, 360], "more": [1, 2],
      "frontier": {"points": [
        {"label": "quarter", "settings": {"resolution_scale": 0.5, "samples_per_pixel": 1},
         "ms": 60, "ms_lower": 59, "relmse": 0.02, "relmse_lower": 0.01, "relmse_upper": 0.03},
        {"label": "short paths", "settings": {"max_depth": 2}, "ms": 120, "relmse": 0.018},
        {"label": "one", "settings": {"samples_per_pixel": 1, "seed": 7}, "ms": 200,
         "relmse": 0.01, "relmse_lower": null},
        {"label": "four", "settings": {"samples_per_pixel": 4, "atrous_iterations": 3},
         "ms": 330, "relmse": 0.004}]}})");
}

TEST(FrontierReport, HoldsWhatTheFileSays)
{
    const FrontierReport report = parse_frontier_report(sound_report().dump(), "r.json");
    EXPECT_EQ(report.size, (Extent{640, 360}));
    ASSERT_EQ(report.points.size(), 4U);
    EXPECT_EQ(report.points[0].label, "quarter");
    EXPECT_EQ(report.points[0].ms, 60);
    EXPECT_EQ(report.points[0].error.value, 0.02);
    EXPECT_EQ(report.points[0].error.upper, 0.03);
    EXPECT_TRUE(std::isnan(report.points[2].error.lower));
    EXPECT_EQ(report.points[3].settings.at("atrous_iterations"), 3);
}

struct Flaw {
    const char* name;
    json patch;  ///< JSON patch (RFC 6902) of the sound report.
    const char* message;
};

class FlawedReport : public testing::TestWithParam<Flaw> { };

TEST_P(FlawedReport, IsRefusedWithPlaceFindingAndExpectation)
{
    try {
        parse_frontier_report(sound_report().patch(GetParam().patch).dump(), "r.json");
        FAIL() << "it was taken";
    } catch (const SceneError& refused) {
        EXPECT_STREQ(refused.what(), GetParam().message);
    }
}

json put(const char* path, json value)
{
    return json::array({{{"op", "add"}, {"path", path}, {"value", std::move(value)}}});
}

json remove(const char* path)
{
    return json::array({{{"op", "remove"}, {"path", path}}});
}

INSTANTIATE_TEST_SUITE_P(Flaws, FlawedReport,
    testing::Values(Flaw{"NoFrontier", remove("/frontier"),
                        "r.json: found no key \"frontier\", expected an object with scene, "
                        "size and frontier, as farlight accuracy writes it"},
        Flaw{"NoSize", remove("/size"),
            "r.json: found no key \"size\", expected an object with scene, size and frontier, as "
            "farlight accuracy writes it"},
        Flaw{"NoScene", remove("/scene"),
            "r.json: found no key \"scene\", expected an object with scene, size and frontier, as "
            "farlight accuracy writes it"},
        Flaw{"SceneAsText", put("/scene", "box"),
            "r.json: /scene: found \"box\", expected an object with name, triangles and lights"},
        Flaw{"SizeAsText", put("/size", "640x360"),
            "r.json: /size: found \"640x360\", expected [width, height] in pixels, 1 to 65536"},
        Flaw{"SizeOfNothing", put("/size/0", 0),
            "r.json: /size/0: found 0, expected an integer from 1 to 65536"},
        Flaw{"FrontierAsList", put("/frontier", json::array()),
            "r.json: /frontier: found an empty array, expected an object with points"},
        Flaw{"NoPoints", put("/frontier/points", json::array()),
            "r.json: /frontier/points: found an empty array, expected an array of one point or "
            "more"},
        Flaw{"PointAsNumber", put("/frontier/points/1", 3),
            "r.json: /frontier/points/1: found 3, expected an object with label, settings, ms and "
            "relmse"},
        Flaw{"NoMs", remove("/frontier/points/0/ms"),
            "r.json: /frontier/points/0: found no key \"ms\", expected an object with label, "
            "settings, ms and relmse"},
        Flaw{"MsOfNothing", put("/frontier/points/0/ms", 0),
            "r.json: /frontier/points/0/ms: found 0, expected a number above 0 [ms]"},
        Flaw{"ErrorAsText", put("/frontier/points/1/relmse", "small"),
            "r.json: /frontier/points/1/relmse: found \"small\", expected a number above 0"},
        Flaw{"UnknownSetting", put("/frontier/points/1/settings/teapot", 1),
            "r.json: /frontier/points/1/settings/teapot: found the unknown key \"teapot\", "
            "expected a setting's key"},
        Flaw{"SettingOutOfRange", put("/frontier/points/2/settings/samples_per_pixel", 0),
            "r.json: /frontier/points/2/settings/samples_per_pixel: found 0, expected another "
            "value: setting 'samples_per_pixel': found 0, expected a whole number from 1 to 1024"},
        Flaw{"NotDearer", put("/frontier/points/2/ms", 119),
            "r.json: /frontier/points/2/ms: found 119, expected more than the point before, 120"},
        Flaw{"NotBetter", put("/frontier/points/2/relmse", 0.018),
            "r.json: /frontier/points/2/relmse: found 0.018, expected less than the point before, "
            "0.018"}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(FrontierReport, IsRefusedWhereItIsNoJsonOrNoFile)
{
    EXPECT_THROW(parse_frontier_report("{", "r.json"), SceneError);
    EXPECT_THROW(read_frontier_report("/no/such/report.json"), SceneError);
}

TEST(FrontierReport, IsRefusedWhereItIsOfAnotherScene)
{
    const FrontierReport report = parse_frontier_report(sound_report().dump(), "r.json");
    EXPECT_NO_THROW(report_for(report, {"Box", 38, 1}, "llvmpipe"));
    for (const SceneIdentity& shown : {SceneIdentity{"Box", 39, 1}, SceneIdentity{"Box", 38, 2}})
        EXPECT_THROW(report_for(report, shown, "llvmpipe"), SceneError);
    try {
        report_for(report, {"Hall", 262267, 24}, "llvmpipe");
        FAIL() << "it was taken";
    } catch (const SceneError& refused) {
        EXPECT_STREQ(refused.what(),
            "r.json: /scene: found \"Box\" of 38 triangles and 1 lights, expected \"Hall\" of "
            "262267 "
            "triangles and 24 lights, which is shown here");
    }
}

TEST(FrontierReport, SaysWhereItsSizeOrDeviceIsAnother)
{
    const FrontierReport read = parse_frontier_report(sound_report().dump(), "r.json");
    const FrontierReport here = report_for(read, read.scene, "llvmpipe");
    const FrontierReport elsewhere = report_for(read, read.scene, "GeForce");
    EXPECT_EQ(otherwise_measured(here, {640, 360}), std::nullopt);
    EXPECT_EQ(otherwise_measured(here, {320, 180}),
        "measured at 640x360; its times are corrected by frames drawn here, its errors are not");
    EXPECT_EQ(otherwise_measured(elsewhere, {640, 360}),
        "measured at 640x360 on llvmpipe; its times are corrected by frames drawn here, its errors "
        "are not");
}

TEST(FrontierReport, GivesTheRungsThatDifferInNothingElse)
{
    const FrontierReport report = parse_frontier_report(sound_report().dump(), "r.json");
    RenderSettings wishes;
    std::vector<Rung> rungs = rungs_of(report, wishes);
    ASSERT_EQ(rungs.size(), 3U);
    EXPECT_EQ(rungs[0].choice, (Choice{0.5F, 1, 5}));
    EXPECT_EQ(rungs[1].choice, (Choice{1, 1, 5}));
    EXPECT_EQ(rungs[2].choice, (Choice{1, 4, 3}));
    EXPECT_EQ(rungs[2].label, "four");
    wishes.max_depth = 2;
    rungs = rungs_of(report, wishes);
    ASSERT_EQ(rungs.size(), 3U);
    EXPECT_EQ(rungs[1].label, "short paths") << "of two points for one choice the cheaper";
}

std::shared_ptr<const FrontierReport> shared_report()
{
    return std::make_shared<FrontierReport>(parse_frontier_report(sound_report().dump(), "r.json"));
}

RenderSettings within(double ms)
{
    RenderSettings wishes;
    wishes.budget_ms = static_cast<float>(ms);
    return wishes;
}

TEST(ReportedFrontier, IsToldBeforeAnyFrameAsItStands)
{
    Controller controller(shared_report());
    controller.follow(RenderSettings(), {640, 360});
    const auto told = controller.news(Controller::Time());
    ASSERT_TRUE(told);
    EXPECT_EQ(told->source, protocol::FrontierSource::kReport);
    ASSERT_EQ(told->points.size(), 3U);
    EXPECT_NEAR(told->points[0].ms, 60, 1e-9);
    EXPECT_EQ(told->points[0].upper, 0.03);
    EXPECT_NEAR(told->points[2].ms, 330, 1e-9);
    EXPECT_EQ(told->points[2].error, 0.004);
    EXPECT_FALSE(told->points[2].upper);
    EXPECT_FALSE(told->reason);
}

/// Four times the pixels take four times as long, but for what does not depend on pixels.
TEST(ReportedFrontier, IsScaledToTheSizeOfThePicture)
{
    Controller controller(shared_report());
    controller.follow(RenderSettings(), {1280, 720});
    for (const Rung& rung : controller.ladder()) {
        const double reported = rung.choice.samples_per_pixel == 4 ? 330
            : rung.choice.resolution_scale < 1                     ? 60
                                                                   : 200;
        EXPECT_LE(rung.ms, 4 * reported * (1 + 1e-9));
        EXPECT_GE(rung.ms, 3 * reported);
    }
    const auto told = controller.news(Controller::Time());
    ASSERT_TRUE(told && told->reason);
    EXPECT_NE(told->reason->find("measured at 640x360"), std::string::npos);
}

/// A frame of four samples would be 1.07e9 path segments, and a session that asks for it is closed.
TEST(ReportedFrontier, LeavesOutWhatIsTooMuchWorkAtThisSize)
{
    Controller controller(shared_report());
    RenderSettings wishes = within(10000);
    wishes.max_depth = 64;
    controller.follow(wishes, {2048, 2048});
    const auto told = controller.news(Controller::Time());
    ASSERT_TRUE(told);
    EXPECT_EQ(told->source, protocol::FrontierSource::kReport);
    ASSERT_EQ(told->points.size(), 2U);
    EXPECT_EQ(told->points[1].settings.at("samples_per_pixel"), 1);
}

TEST(ReportedFrontier, TellsTheRightRungBeforeTheFirstFrame)
{
    ScriptedDevice device(kSoftware, within(250), shared_report());
    device.draw_for(5);
    EXPECT_EQ(device.frames.front().choice, (Choice{1, 1, 5}));
    EXPECT_EQ(device.controller.steps(), 0U);
}

/// A machine three times as slow as the report's.
TEST(ReportedFrontier, IsCorrectedByWhatFramesTake)
{
    ScriptedDevice device(kSoftware, within(250), shared_report());
    device.draw_for(20, [](double) { return 3; });
    EXPECT_EQ(device.frames.back().choice, (Choice{0.5F, 1, 5}));
    EXPECT_LE(frames_until_settled(device.frames, 0, 20), 10);
    EXPECT_NEAR(device.controller.ladder()[0].ms, device.frames.back().ms, 0.01);
    EXPECT_EQ(device.controller.ladder()[0].error->value, 0.02);
}

TEST(ReportedFrontier, IsNotUsedWhereNoPointIsAsWished)
{
    RenderSettings wishes = within(250);
    wishes.denoiser = Denoiser::kAccumulate;
    json other = sound_report();
    for (json& point : other["frontier"]["points"])
        point["settings"]["denoiser"] = "svgf";
    Controller controller(
        std::make_shared<FrontierReport>(parse_frontier_report(other.dump(), "r.json")));
    controller.follow(wishes, {640, 360});
    EXPECT_GT(controller.ladder().size(), 10U);
    const Controller::Time now{};
    EXPECT_FALSE(controller.news(now)) << "nothing is known of it yet";
    for (int frame = 0; frame < 2; ++frame)
        controller.drawn({choice_of(controller.settings(false)), 10, 10}, now);
    const auto told = controller.news(now);
    ASSERT_TRUE(told);
    EXPECT_EQ(told->source, protocol::FrontierSource::kLearnt);
    EXPECT_TRUE(told->reason) << "a report that was given is not followed";
}

}  // namespace
}  // namespace farlight
