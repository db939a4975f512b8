// Which points a sweep has, from what a server lists.
#include "client/accuracy/grid.h"

#include <gmock/gmock.h>
#include <set>

namespace farlight {
namespace {

using namespace client;
using nlohmann::json;
using testing::Contains;
using testing::Each;
using testing::Not;

/// As describe_settings() writes them, with a denoiser that does not exist yet.
json described(bool with_resolution)
{
    json settings = json::parse(R"([
        {"key":"denoiser","type":"choice","value":"svgf","choices":["none","accumulate","svgf","dream"]},
        {"key":"samples_per_pixel","type":"integer","value":2,"lower":1,"upper":16},
        {"key":"max_depth","type":"integer","value":6,"lower":1,"upper":64},
        {"key":"light_sampling","type":"boolean","value":true},
        {"key":"atrous_iterations","type":"integer","value":5,"lower":0,"upper":8},
        {"key":"history_max","type":"integer","value":32,"lower":1,"upper":4096},
        {"key":"seed","type":"integer","value":0,"lower":0,"upper":9}])");
    if (with_resolution)
        settings.push_back(json::parse(
            R"({"key":"resolution_scale","type":"real","value":1,"lower":0.25,"upper":1})"));
    return settings;
}

std::vector<std::string> labels(const Grid& grid)
{
    std::vector<std::string> all;
    for (const SweepPoint& point : grid.points)
        all.push_back(point.label);
    return all;
}

TEST(SweepGrid, StartsFromOneSampleAndTheServersOwnValues)
{
    const Grid grid = make_grid(described(false), GridSize::kQuick);
    EXPECT_EQ(grid.base.at("samples_per_pixel"), 1);
    EXPECT_EQ(grid.base.at("max_depth"), 6);
    EXPECT_FALSE(grid.base.contains("seed"));
    EXPECT_EQ(grid.points.front().settings, grid.base);
    EXPECT_EQ(grid.points.front().label, "svgf, 1 sample");
}

TEST(SweepGrid, EveryDenoiserButAveragingAppears)
{
    const auto all = labels(make_grid(described(false), GridSize::kQuick));
    for (const char* label : {"none, 1 sample", "none, 16 samples", "svgf, 4 samples",
             "dream, 1 sample", "dream, 4 samples"})
        EXPECT_THAT(all, Contains(label));
    EXPECT_THAT(all, Each(Not(testing::HasSubstr("accumulate"))));
}

TEST(SweepGrid, EverySettingIsSweptWithinItsRange)
{
    const Grid grid = make_grid(described(true), GridSize::kNormal);
    const auto all = labels(grid);
    for (const char* label : {"svgf, 1 sample, depth 2", "svgf, 1 sample, depth 4",
             "none, 1 sample, light sampling false", "svgf, 1 sample, light sampling false",
             "svgf, 1 sample, a-trous 0", "svgf, 1 sample, history 1",
             "svgf, 1 sample, resolution 0.5", "none, 1 sample, resolution 0.25",
             "svgf, 2 samples, a-trous 3, resolution 0.5"})
        EXPECT_THAT(all, Contains(label));
    for (const SweepPoint& point : grid.points) {
        EXPECT_LE(point.samples(), 16) << point.label;
        EXPECT_EQ(point.settings.size(), grid.base.size()) << point.label;
    }
}

TEST(SweepGrid, NoTwoPointsAreAlike)
{
    for (const GridSize size : {GridSize::kTiny, GridSize::kQuick, GridSize::kNormal}) {
        const Grid grid = make_grid(described(true), size);
        std::set<std::string> ids, names;
        for (const SweepPoint& point : grid.points) {
            ids.insert(point.id());
            names.insert(point.label);
        }
        EXPECT_EQ(ids.size(), grid.points.size());
        EXPECT_EQ(names.size(), grid.points.size());
    }
}

TEST(SweepGrid, ASettingThatTheServerLacksIsNotSwept)
{
    for (const SweepPoint& point : make_grid(described(false), GridSize::kNormal).points)
        EXPECT_FALSE(point.settings.contains("resolution_scale"));
    EXPECT_THROW(make_grid(json::array(), GridSize::kQuick), std::invalid_argument);
}

TEST(SweepGrid, ChangesAreNamed)
{
    Settings from{{"denoiser", "none"}, {"samples_per_pixel", 1}, {"max_depth", 4}};
    Settings to{{"denoiser", "svgf"}, {"samples_per_pixel", 4}, {"max_depth", 4}};
    EXPECT_EQ(changes_between(from, to), "denoiser none \u2192 svgf, samples 1 \u2192 4");
    EXPECT_EQ(changes_between(from, from), "");
    from["atrous_iterations"] = 5;
    to["atrous_iterations"] = 0;
    EXPECT_EQ(
        changes_between(from, to), "a-trous 0, denoiser none \u2192 svgf, samples 1 \u2192 4");
    EXPECT_EQ(changes_between(to, from), "denoiser svgf \u2192 none, samples 4 \u2192 1");
}

}  // namespace
}  // namespace farlight
