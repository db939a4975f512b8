// What a sweep concludes, from measurements made up so that the conclusions are known.
#include "client/accuracy/findings.h"

#include "client/accuracy/report_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace farlight {
namespace {

using namespace client;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr double kBias = 0.001;  // of the filter, squared

json exactly(double value)
{
    return {{"value", value}, {"lower", 0.9 * value}, {"upper", 1.1 * value}};
}

json error_of(double relmse, bool limited = false)
{
    return {{"relmse", exactly(relmse)}, {"bias", exactly(0)}, {"variance", exactly(relmse)},
        {"relmse999", relmse}, {"mse", relmse / 10}, {"fireflies", 0}, {"flip", std::sqrt(relmse)},
        {"reference_limited", limited}};
}

json times_of(double ms, double whole)
{
    return {{"ms", {{"value", ms}, {"lower", 0.99 * ms}, {"upper", 1.01 * ms}}},
        {"passes", json::array({{{"name", "path_trace"}, {"ms", ms}}})}, {"encode_ms", 0.1},
        {"whole_ms", whole}};
}

MeasuredPoint point(const char* denoiser, int samples, double ms, double relmse)
{
    return {{.label = std::string(denoiser) + ", " + std::to_string(samples),
                .settings = {{"denoiser", denoiser}, {"samples_per_pixel", samples}}},
        error_of(relmse), times_of(ms, 1.02 * ms)};
}

/// Raw samples take 1 ms each and have the error 0.1 / n; the filter takes 2 ms more and has a
/// hundredth of that, and a bias.
Measurements invented()
{
    Measurements measured{.base = {{"denoiser", "svgf"}, {"samples_per_pixel", 1}}};
    for (const int samples : {1, 2, 4})
        measured.points.push_back(point("none", samples, samples, 0.1 / samples));
    for (const int samples : {1, 4})
        measured.points.push_back(
            point("svgf", samples, samples + 2.0, kBias + 0.003 / (samples + 2.0)));
    for (const int frames : {1, 10, 100})
        measured.averaging[frames] = error_of(0.1 / frames);
    measured.averaging_times = times_of(1, 1);
    return measured;
}

TEST(Findings, FrontierAscendsInTimeAndHoldsNoDominatedPoint)
{
    const json findings = findings_of(invented());
    const json& points = findings["frontier"]["points"];
    ASSERT_EQ(points.size(), 4U) << points;  // raw 4 is beaten by svgf 1
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_LT(points[i - 1]["ms"], points[i]["ms"]);
        EXPECT_GT(points[i - 1]["relmse"], points[i]["relmse"]);
    }
    for (const char* key : {"label", "settings", "ms", "ms_lower", "ms_upper", "relmse",
             "relmse_lower", "relmse_upper", "flip"})
        EXPECT_TRUE(points[0].contains(key)) << key;
    EXPECT_EQ(points[0]["settings"]["denoiser"], "none");
}

TEST(Findings, LightLeftToChanceIsNoChoice)
{
    Measurements measured = invented();
    measured.base["light_sampling"] = true;
    for (MeasuredPoint& each : measured.points)
        each.point.settings["light_sampling"] = true;
    measured.points.push_back(point("none", 1, 0.5, 5));
    measured.points.back().point.settings["light_sampling"] = false;
    const json findings = findings_of(measured);
    EXPECT_EQ(findings["frontier"]["points"][0]["label"], "none, 1");
    EXPECT_EQ(findings["frontier"]["points"][0]["ms"], 1.0);
    EXPECT_EQ(findings["techniques"][1]["name"], "light sampling, raw");
}

TEST(Findings, APointLostInTheReferencesNoiseIsOnNoFrontier)
{
    Measurements measured = invented();
    measured.points.push_back(point("svgf", 2, 0.5, 1e-9));
    measured.points.back().error["reference_limited"] = true;
    EXPECT_EQ(findings_of(measured)["frontier"]["points"].size(), 4U);
}

TEST(Findings, OfNoErrorNothingIsConcluded)
{
    Measurements measured = invented();
    for (MeasuredPoint& each : measured.points)
        each.error = error_of(0, /*limited=*/true);
    for (auto& [frames, error] : measured.averaging)
        error = error_of(0, /*limited=*/true);
    const json findings = findings_of(measured);
    for (const json* part : {&findings["frontier"]["points"], &findings["prices"],
             &findings["fits"], &findings["flip_frontier"]})
        EXPECT_EQ(part->size(), 0U) << *part;
    EXPECT_FALSE(findings["averaging"].contains("rate"));
    EXPECT_TRUE(findings["slope"].empty());
}

TEST(Findings, PricesNameTheSettingsThatChange)
{
    const json prices = findings_of(invented())["prices"];
    EXPECT_EQ(prices[0]["to"], 2);
    EXPECT_EQ(prices[0]["extra_ms"], 1.0);
    EXPECT_EQ(prices[0]["by"], "samples 1 \u2192 2");
    EXPECT_EQ(prices[1]["by"], "denoiser none \u2192 svgf, samples 2 \u2192 1");
    EXPECT_NEAR(prices[0]["averaging_ms"].get<double>(), 2, 1e-12);  // 0.1 / t = 0.05
    EXPECT_FALSE(prices[3].contains("extra_ms"));
}

TEST(Findings, AveragingTakesAFrameAtLeast)
{
    Measurements measured = invented();
    measured.points.push_back(point("none", 1, 0.5, 5));
    measured.points.back().point.settings["resolution_scale"] = 0.5;
    EXPECT_EQ(findings_of(measured)["prices"][0]["averaging_ms"], 1.0);  // 0.04 by the rate alone
}

TEST(Findings, FitsCrossWhereAveragingIsBetter)
{
    const json findings = findings_of(invented());
    EXPECT_NEAR(findings["slope"]["relmse"].get<double>(), -1, 1e-12);
    const json& fits = findings["fits"];
    const auto svgf = std::find_if(
        fits.begin(), fits.end(), [](const json& fit) { return fit["denoiser"] == "svgf"; });
    ASSERT_NE(svgf, fits.end());
    EXPECT_NEAR((*svgf)["floor"].get<double>(), kBias, 1e-12);
    EXPECT_NEAR((*svgf)["crossing_ms"].get<double>(), (0.1 - 0.003) / kBias, 1e-6);
    EXPECT_FALSE((*svgf)["floor_is_measured"].get<bool>());
}

TEST(Findings, ABiasThatSeedsShowIsTheFloor)
{
    Measurements measured = invented();
    measured.points.back().error["bias"] = exactly(0.0008);
    const json fits = findings_of(measured)["fits"];
    EXPECT_EQ(fits[0]["floor"], 0.0008);
    EXPECT_TRUE(fits[0]["floor_is_measured"].get<bool>());
}

TEST(Findings, PassSumsAreCheckedAgainstWholeFrames)
{
    Measurements measured = invented();
    json check = findings_of(measured)["timing_check"];
    EXPECT_NEAR(check["worst"].get<double>(), 1 - 1 / 1.02, 1e-12);
    EXPECT_EQ(check["beyond"], 0);
    EXPECT_FALSE(check["failed"].get<bool>());
    measured.points[0].times["whole_ms"] = 1.1;
    check = findings_of(measured)["timing_check"];
    EXPECT_EQ(check["beyond"], 1);
    EXPECT_FALSE(check["failed"].get<bool>());
    measured.points[0].times["whole_ms"] = 2.0;
    EXPECT_TRUE(findings_of(measured)["timing_check"]["failed"].get<bool>());
}

json report_of(const Measurements& measured)
{
    json report = findings_of(measured);
    report["base"] = measured.base;
    return report;
}

TEST(ReportFiles, CsvHasALineAPointAndQuotesText)
{
    Measurements measured = invented();
    measured.points[0].point.label = "say \"none\", 1";
    const std::string csv = csv_of(report_of(measured));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5);
    EXPECT_THAT(csv, StartsWith("label,frontier,ms,"));
    EXPECT_THAT(csv, HasSubstr("\"say \"\"none\"\", 1\",1,1.0,"));
    EXPECT_THAT(csv.substr(0, csv.find("\r\n")), testing::EndsWith(",denoiser,samples_per_pixel"));
}

TEST(ReportFiles, ThePageNeedsNothingElseAndSceneNamesCannotBreakIt)
{
    Measurements measured = invented();
    measured.points[0].point.label = "</script><script>alert(1)</script><!--";
    const std::string page = page_of(report_of(measured));
    EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
    EXPECT_THAT(page, HasSubstr("\\u003c/script>\\u003cscript>alert(1)"));
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http", "fetch("})
        EXPECT_THAT(page, Not(HasSubstr(outside)));
    EXPECT_THAT(page, HasSubstr("Copyright (c) 2022 Leon Sorokin"));  // as the licence asks for
}

TEST(ReportFiles, SummaryIsMarkdown)
{
    const std::string text = summary_text(report_of(invented()));
    EXPECT_THAT(text, HasSubstr("| none, 1 | 1.0 | 0.1 | +1.0 ms | samples 1 \u2192 2 |\n"));
    EXPECT_THAT(text, HasSubstr("| beyond this sweep | |\n"));
    EXPECT_THAT(text, HasSubstr("| svgf, 1 | 333.3 | 0.002 | 0.045 |\n"));
}

}  // namespace
}  // namespace farlight
