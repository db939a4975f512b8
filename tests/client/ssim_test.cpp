// SSIM of pairs with closed values.
#include "client/metrics/ssim.h"

#include "tests/client/synthetic_pictures.h"

#include <gtest/gtest.h>
#include <limits>

namespace farlight {
namespace {

using namespace client;

double gray_scene(int x, int y, int)
{
    return synthetic_scene(x, y, 2) / 255.0;
}

TEST(Ssim, EqualPicturesAreAlike)
{
    const auto x = synthetic_picture(gray_scene);
    EXPECT_NEAR(structural_similarity(x, x, kSyntheticSize), 1, 1e-12);
}

/// Without contrast only the means are compared: (2 a b + C1) / (a^2 + b^2 + C1).
TEST(Ssim, FlatPicturesCompareByBrightness)
{
    const std::vector<float> a(3 * kSyntheticSize.pixels(), 0.25F);
    const std::vector<float> b(3 * kSyntheticSize.pixels(), 0.75F);
    EXPECT_NEAR(structural_similarity(a, b, kSyntheticSize),
        (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-10);
}

/// r = 1/2 + w and x = 1/2 - w with w of local mean 0 but for rounding: similarity of structure is
/// (-2 v + C2) / (2 v + C2). A checkerboard of single pixels is as good as mean 0 under the window.
TEST(Ssim, OppositeStructureIsUnlike)
{
    const auto checks = [](double sign) {
        return [=](int x, int y, int) { return 0.5 + sign * ((x + y) % 2 == 0 ? 0.25 : -0.25); };
    };
    const double v = 0.0625;
    EXPECT_NEAR(structural_similarity(
                    synthetic_picture(checks(1)), synthetic_picture(checks(-1)), kSyntheticSize),
        (-2 * v + 9e-4) / (2 * v + 9e-4), 1e-4);
}

TEST(Ssim, SeesBlurButNotAMaskedPlace)
{
    const auto r = synthetic_picture(gray_scene);
    auto x = r;
    for (std::size_t i = 0; i < 2880; ++i)
        x[i] = 0.5F;  // ten rows
    EXPECT_LT(structural_similarity(x, r, kSyntheticSize), 0.95);
    std::vector<std::uint8_t> below(kSyntheticSize.pixels(), 1);
    std::fill_n(below.begin(), 96 * 15, std::uint8_t{0});  // and the 5 rows whose windows see it
    EXPECT_NEAR(structural_similarity(x, r, kSyntheticSize, below), 1, 1e-12);
}

TEST(Ssim, RefusesWhatIsTooSmallOrNotFinite)
{
    const std::vector<float> small(600, 0.5F);
    EXPECT_THROW(structural_similarity(small, small, {10, 20}), MetricError);
    auto bad = synthetic_picture(gray_scene);
    bad[7] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(
        structural_similarity(bad, synthetic_picture(gray_scene), kSyntheticSize), MetricError);
}

}  // namespace
}  // namespace farlight
