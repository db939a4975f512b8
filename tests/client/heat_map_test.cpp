// Colours of errors.
#include "client/metrics/heat_map.h"

#include <cmath>
#include <gmock/gmock.h>

namespace farlight {
namespace {

using namespace client;
using testing::ElementsAre;

/// Five of matplotlib's 256 colours; the polynomial may be 4 of 255 levels off.
TEST(HeatMap, MagmaIsMagma)
{
    struct Point {
        int i;
        Shade shade;
    };
    for (const auto& [i, shade] :
        {Point{0, {0.001462, 0.000466, 0.013866}}, Point{64, {0.316654, 0.071690, 0.485380}},
            Point{128, {0.716387, 0.214982, 0.475290}}, Point{192, {0.986700, 0.535582, 0.382210}},
            Point{255, {0.987053, 0.991438, 0.749504}}}) {
        EXPECT_NEAR(magma(i / 255.0).r, shade.r, 0.02) << i;
        EXPECT_NEAR(magma(i / 255.0).g, shade.g, 0.02) << i;
        EXPECT_NEAR(magma(i / 255.0).b, shade.b, 0.02) << i;
    }
}

TEST(HeatMap, MagmaGetsBrighter)
{
    double last = -1;
    for (int i = 0; i <= 100; ++i) {
        const Shade shade = magma(i / 100.0);
        const double now = luminance(shade.r, shade.g, shade.b);
        EXPECT_GE(now, last) << i;
        last = now;
    }
}

TEST(HeatMap, SignsHaveColoursAndNoneIsWhite)
{
    const std::vector<float> reference{1, 1, 1, 1, 1, 1, 1, 1, 1};
    const std::vector<float> test{0, 0, 0, 1, 1, 1, 9, 9, 9};
    const auto shown = signed_heat_map(test, reference, {3, 1}).display;
    EXPECT_GT(shown[2], shown[0]);  // too dark is blue
    EXPECT_THAT(std::vector(shown.begin() + 3, shown.begin() + 6), ElementsAre(255, 255, 255));
    EXPECT_GT(shown[6], shown[8]);  // too bright is red
}

TEST(HeatMap, AbsoluteErrorsAreShownByTheirLogarithm)
{
    const std::vector<float> reference(9, 0.0F);
    const std::vector<float> test{0, 0, 0, 0.1F, 0.1F, 0.1F, 10, 10, 10};
    const Picture shown = absolute_heat_map(test, reference, {3, 1});
    const Picture levels = heat_map(std::vector<float>{0, 0.5F, 1}, {3, 1});
    EXPECT_EQ(shown.display, levels.display);
    EXPECT_EQ(shown.width, 3);
    EXPECT_THROW(heat_map(std::vector<float>(4), {3, 1}), MetricError);
    EXPECT_THROW(absolute_heat_map(test, reference, {2, 1}), MetricError);
}

}  // namespace
}  // namespace farlight
