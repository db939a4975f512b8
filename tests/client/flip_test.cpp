// FLIP against numbers that NVIDIA's implementation gives for the same pictures.
//
// The goldens come from NVlabs/flip, src/pytorch/flip_loss.py (2-D filters, so not ours separated),
// carried over to double precision without change of its arithmetic. Its repository also states the
// means 0.159691 (LDR) and 0.283478 (HDR) of its own example pictures, which we do not have.
#include "client/metrics/flip.h"
#include "client/metrics/flip_color.h"
#include "tests/client/synthetic_pictures.h"

#include <functional>
#include <gmock/gmock.h>
#include <limits>

namespace farlight {
namespace {

using namespace client;
using PixelValue = std::function<double(int, int, int)>;

constexpr double kGoldenTolerance = 1e-5;  // the goldens' printed digits and float error maps

double shown(int value)
{
    return std::clamp(value, 0, 255) / 255.0;
}

double grainy(int x, int y, int c)
{
    const int away = synthetic_noise(x, y, c) - 128;
    return shown(synthetic_scene(x, y, c) + (away >= 0 ? away / 4 : -((3 - away) / 4)));
}

double plain(int x, int y, int c)
{
    return shown(synthetic_scene(x, y, c));
}

PixelValue disc(int middle)
{
    return [=](int x, int y, int) {
        return shown((x - middle) * (x - middle) + (y - 32) * (y - 32) < 225 ? 230 : 60);
    };
}

double tinted(int x, int y, int c)
{
    constexpr int kTint[] = {30, -20, 10};
    return shown(synthetic_scene(x, y, c) + kTint[c]);
}

PixelValue opposite(int other)
{
    return [=](int x, int y, int c) { return (x / 16 + y / 16 + (c == 2 ? 1 : 0) + other) % 2; };
}

struct LdrGolden {
    const char* name;
    PixelValue test;
    PixelValue reference;
    double pixels_per_degree;
    Pooled pooled;
    double at_40_20;
};
class LdrFlip : public testing::TestWithParam<LdrGolden> { };

void expect_pooled(const Pooled& found, const Pooled& expected)
{
    EXPECT_NEAR(found.mean, expected.mean, kGoldenTolerance);
    EXPECT_NEAR(found.weighted_median, expected.weighted_median, kGoldenTolerance);
    EXPECT_NEAR(found.first_quartile, expected.first_quartile, kGoldenTolerance);
    EXPECT_NEAR(found.third_quartile, expected.third_quartile, kGoldenTolerance);
    EXPECT_NEAR(found.lowest, expected.lowest, kGoldenTolerance);
    EXPECT_NEAR(found.highest, expected.highest, kGoldenTolerance);
}

TEST_P(LdrFlip, IsThatOfItsAuthors)
{
    const LdrGolden& golden = GetParam();
    const auto map = ldr_flip(synthetic_picture(golden.test), synthetic_picture(golden.reference),
        kSyntheticSize, golden.pixels_per_degree);
    expect_pooled(pool(map), golden.pooled);
    EXPECT_NEAR(map[20 * 96 + 40], golden.at_40_20, kGoldenTolerance);
}

INSTANTIATE_TEST_SUITE_P(Goldens, LdrFlip,
    testing::Values(
        LdrGolden{"Noise", grainy, plain, kPixelsPerDegree,
            {0.1447467, 0.1620807, 0.1231719, 0.2109776, 0.0066942, 0.4791776}, 0.1069255},
        LdrGolden{"NoiseFromAfar", grainy, plain, 30,
            {0.2643637, 0.2961106, 0.2308523, 0.3723119, 0.0246911, 0.6161196}, 0.2489818},
        LdrGolden{"MovedEdge", disc(50), disc(48), kPixelsPerDegree,
            {0.0438941, 0.5775026, 0.3836053, 0.7279980, 0, 0.8673692}, 0.5775026},
        LdrGolden{"Tint", tinted, plain, kPixelsPerDegree,
            {0.4091483, 0.4518307, 0.3638944, 0.5267700, 0.0499822, 0.5830646}, 0.2683707},
        LdrGolden{"Opposite", opposite(0), opposite(1), kPixelsPerDegree,
            {0.9478972, 0.9849838, 0.9724242, 0.9945664, 0.3759782, 0.9989721}, 0.9922869}),
    [](const auto& tested) { return tested.param.name; });

double noisy_light(int x, int y, int c)
{
    return synthetic_light(x, y, c) * (1 + (synthetic_noise(x, y, c) - 128) / 256.0);
}

double sparks(int x, int y, int c)
{
    return synthetic_light(x, y, c) * (synthetic_noise(x, y, 7) < 3 ? 64 : 1);
}

TEST(HdrFlip, IsThatOfItsAuthors)
{
    const auto reference = synthetic_picture(synthetic_light);
    const FlipExposures exposures = flip_exposures(reference);
    EXPECT_NEAR(exposures.start, -3.707021859910579, 1e-12);
    EXPECT_NEAR(exposures.stop, 0.4489560580003823, 1e-12);
    EXPECT_EQ(exposures.count, 5);
    expect_pooled(pool(hdr_flip(synthetic_picture(noisy_light), reference, kSyntheticSize)),
        {0.1627403, 0.1756232, 0.1389502, 0.2179317, 0.0162991, 0.4495160});
    const auto sparkling = synthetic_picture(sparks);
    expect_pooled(pool(hdr_flip(sparkling, reference, kSyntheticSize)),
        {0.0774933, 0.2882933, 0.1087932, 0.4752134, 0, 0.9247112});
    expect_pooled(pool(hdr_flip(sparkling, reference, kSyntheticSize, kPixelsPerDegree,
                      FlipExposures{-3, 2, 5})),
        {0.0678349, 0.2504686, 0.0911488, 0.4297961, 0, 0.9227993});
}

TEST(Flip, EqualPicturesHaveNone)
{
    const auto shown_picture = synthetic_picture(plain);
    for (const float error : ldr_flip(shown_picture, shown_picture, kSyntheticSize))
        EXPECT_EQ(error, 0);
    const auto light = synthetic_picture(synthetic_light);
    for (const float error : hdr_flip(light, light, kSyntheticSize))
        EXPECT_EQ(error, 0);
}

TEST(Flip, BlackAndMostlyBlackReferencesHaveExposures)
{
    std::vector<float> picture(3 * kSyntheticSize.pixels(), 0.0F);
    EXPECT_EQ(flip_exposures(picture).count, 2);
    EXPECT_EQ(pool(hdr_flip(picture, picture, kSyntheticSize)).highest, 0);
    std::fill_n(picture.begin(), 300, 0.5F);
    const FlipExposures exposures = flip_exposures(picture);
    EXPECT_TRUE(std::isfinite(exposures.stop));
    EXPECT_EQ(exposures.start, exposures.stop);
}

TEST(Flip, RefusesWhatCannotBeCompared)
{
    auto picture = synthetic_picture(plain);
    EXPECT_THROW(ldr_flip(picture, picture, {64, 95}), MetricError);
    picture[5] = std::numeric_limits<float>::infinity();
    EXPECT_THROW(ldr_flip(picture, synthetic_picture(plain), kSyntheticSize), MetricError);
    EXPECT_THROW(hdr_flip(synthetic_picture(plain), picture, kSyntheticSize), MetricError);
}

/// 1, 2, 3, 4: errors up to 3 make up half (and 60 %) of the sum of 10, those up to 2 a quarter.
TEST(Flip, PoolingWeighsErrorsByTheirSize)
{
    const std::vector<float> errors{4, 1, 3, 2};
    const Pooled pooled = pool(errors);
    EXPECT_EQ(pooled.mean, 2.5);
    EXPECT_EQ(pooled.weighted_median, 3);
    EXPECT_EQ(pooled.first_quartile, 2);
    EXPECT_EQ(pooled.third_quartile, 4);
    const std::vector<std::uint8_t> only{1, 0, 0, 0};
    EXPECT_EQ(pool(errors, only).lowest, 4);
    EXPECT_THROW(pool(errors, std::vector<std::uint8_t>(4, 0)), MetricError);
}

TEST(FlipColor, WhiteIsWhiteInEverySpace)
{
    const Color white = ycxcz_of_linear({1, 1, 1});
    EXPECT_NEAR(white.x, 100, 1e-9);
    EXPECT_NEAR(white.y, 0, 1e-9);
    EXPECT_NEAR(white.z, 0, 1e-9);
    const Color back = screen_of_ycxcz(ycxcz_of_linear({0.2, 0.5, 0.7}));
    EXPECT_NEAR(back.x, 0.2, 1e-7);
    EXPECT_NEAR(back.y, 0.5, 1e-7);
    EXPECT_NEAR(back.z, 0.7, 1e-7);
    EXPECT_NEAR(color_difference({0, 1, 0}, {0, 0, 1}), 1, 1e-12);
}

}  // namespace
}  // namespace farlight
