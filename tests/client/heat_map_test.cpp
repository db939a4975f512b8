// Colours of errors.
#include "client/metrics/heat_map.h"

#include <array>
#include <gmock/gmock.h>
#include <limits>

namespace farlight {
namespace {

using namespace client;
using testing::ElementsAre;

/// Five of matplotlib's 256 colours; between the palette's ten a level or two is lost.
TEST(HeatMap, MagmaIsMagma)
{
    struct Point {
        int i;
        std::array<double, 3> shade;
    };
    for (const auto& [i, shade] :
        {Point{0, {0.001462, 0.000466, 0.013866}}, Point{64, {0.316654, 0.071690, 0.485380}},
            Point{128, {0.716387, 0.214982, 0.475290}}, Point{192, {0.986700, 0.535582, 0.382210}},
            Point{255, {0.987053, 0.991438, 0.749504}}}) {
        const auto bytes = colored(std::vector{static_cast<float>(i) / 255}, Palette::kMagma);
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(bytes[c] / 255.0, shade[c], 0.02) << i << " " << c;
    }
}

TEST(HeatMap, PalettesHoldTheirEnds)
{
    const std::vector<float> shares{-1, 0, 0.5F, 1, 2, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_THAT(colored(shares, Palette::kDiverging),
        ElementsAre(0x00, 0x72, 0xb2, 0x00, 0x72, 0xb2, 0xff, 0xff, 0xff, 0xd5, 0x5e, 0x00, 0xd5,
            0x5e, 0x00, 0x00, 0x72, 0xb2));
    // In grey they ascend.
    for (const Palette palette : {Palette::kMagma, Palette::kViridis}) {
        double before = -1;
        for (int eighth = 0; eighth <= 8; ++eighth) {
            const auto rgb = colored(std::vector{static_cast<float>(eighth) / 8}, palette);
            const double grey = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            EXPECT_GT(grey, before);
            before = grey;
        }
    }
}

TEST(HeatMap, LogarithmicAndSignedShares)
{
    EXPECT_THAT(log_shares(std::vector{0.0F, 0.01F, 0.1F, 1.0F}, 0.01, 1),
        ElementsAre(0, testing::FloatNear(0, 1e-6F), testing::FloatNear(0.5F, 1e-6F), 1));
    EXPECT_THAT(signed_shares(std::vector{-2.0F, 0.0F, 1.0F}, 2), ElementsAre(0, 0.5F, 0.75F));
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
