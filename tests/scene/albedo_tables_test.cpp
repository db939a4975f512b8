// The integrals behind the albedo tables against values from an independent quadrature, and against
// each other.
#include "server/scene/albedo_tables.h"

#include <cmath>
#include <gtest/gtest.h>

namespace farlight {
namespace {

constexpr double kAlphas[] = {0.001, 0.1, 0.25, 0.5, 1};
constexpr double kCosines[] = {1, 0.7, 0.3, 0.1, 0.05};
constexpr double kAlbedo[5][5] = {{1, 1, 1, 0.9999, 0.9998},
    {0.9883, 0.9814, 0.9363, 0.8835, 0.9118}, {0.9158, 0.8853, 0.8379, 0.8916, 0.9331},
    {0.6879, 0.6830, 0.7453, 0.8601, 0.9126}, {0.3069, 0.3789, 0.5601, 0.7602, 0.8478}};
constexpr double kMean[] = {1, 0.9721, 0.8823, 0.7003, 0.4092};

// Four digits and the lattice's error.
constexpr double kTolerance = 3e-4;

TEST(AlbedoTables, GgxReflectsWhatAnIndependentQuadratureSays)
{
    for (int a = 0; a < 5; ++a)
        for (int c = 0; c < 5; ++c)
            EXPECT_NEAR(reflection_albedo(kCosines[c], kAlphas[a]).total, kAlbedo[a][c], kTolerance)
                << "alpha " << kAlphas[a] << ", cosine " << kCosines[c];
}

TEST(AlbedoTables, MeanOverTheHemisphere)
{
    for (int a = 0; a < 5; ++a) {
        double mean = 0;
        constexpr int kSteps = 100;
        for (int i = 0; i < kSteps; ++i) {
            const double cosine = (i + 0.5) / kSteps;
            mean += reflection_albedo(cosine, kAlphas[a]).total * 2 * cosine / kSteps;
        }
        EXPECT_NEAR(mean, kMean[a], kTolerance) << "alpha " << kAlphas[a];
    }
}

/// Of a nearly smooth surface Schlick's mean weight is the weight at the viewer's angle.
TEST(AlbedoTables, SchlickOfASmoothSurface)
{
    for (const double cosine : {0.1, 0.3, 0.7})
        EXPECT_NEAR(reflection_albedo(cosine, 1e-3).schlick, std::pow(1 - cosine, 5), 1e-3);
}

/// A very dense medium reflects all light, so transmission no longer counts; and no interface is
/// smooth enough to lose nothing, or rough enough to gain.
TEST(AlbedoTables, DielectricBetweenItsLimits)
{
    for (const double alpha : kAlphas)
        for (const double cosine : kCosines) {
            EXPECT_NEAR(dielectric_albedo(cosine, alpha, 1e6),
                reflection_albedo(cosine, alpha).total, 2e-3);
            EXPECT_NEAR(dielectric_albedo(cosine, 1e-6, 1.5), 1, 1e-4);
            for (const double eta : {1 / 1.5, 1.0, 1.5}) {
                EXPECT_GT(dielectric_albedo(cosine, alpha, eta), 0.2);
                EXPECT_LE(dielectric_albedo(cosine, alpha, eta), 1 + 1e-9);
            }
        }
}

}  // namespace
}  // namespace farlight
