// Every lobe and mixture of bsdf/bsdf.glsl: materials that absorb nothing lose nothing (white
// furnace), and what a material does not call for changes no bit of it. That samples follow their
// density: lab/cases_samplers.cpp.
//
// Seeds are fixed, so the tests are deterministic. With fresh seeds a furnace test would fail by
// chance once in 1.7 million (5 standard errors).
#include "lab/bsdf_probe.h"
#include "shaders/shared/scene_layout.h"
#include "tests/support/gl_test.h"

#include <cmath>
#include <cstring>

namespace farlight {

void PrintTo(const BsdfFamily& family, std::ostream* out);
void PrintTo(const BsdfFamily& family, std::ostream* out)
{
    *out << family.name;
}

namespace {

using Vec3 = glm::dvec3;

constexpr std::size_t kSamples = 1U << 17U;

class BsdfSampling : public GlTest, public testing::WithParamInterface<BsdfFamily> {
protected:
    /// What the case calls for alone.
    static BsdfMacros special(const BsdfCase& c)
    {
        const Material& m = c.material;
        const bool sharp = m.roughness <= MIRROR_ROUGHNESS;
        BsdfMacros macros;
        if (m.metallic > 0 || m.specular > 0)
            macros.emplace_back(sharp ? "FX_MIRROR" : "FX_ROUGH_REFLECTION");
        if (m.transmission > 0)
            macros.emplace_back("FX_DIELECTRIC");
        if (m.transmission > 0 && !sharp)
            macros.emplace_back("FX_ROUGH_DIELECTRIC");
        if (m.clearcoat > 0)
            macros.emplace_back("FX_CLEARCOAT");
        if (c.tilt != glm::vec2(0) || c.coat_tilt != glm::vec2(0))
            macros.emplace_back("FX_NORMAL_MAPS");
        return macros;
    }
};

TEST_P(BsdfSampling, WhiteFurnace)
{
    for (const BsdfCase& c : GetParam().cases) {
        Vec3 sum(0);
        Vec3 squares(0);
        double largest = 0;
        for (const BsdfDraw& d : draw_bsdf(c, kSamples)) {
            const Vec3 all = d.weight + d.wi;
            ASSERT_TRUE(std::isfinite(all.x + all.y + all.z + d.pdf)) << c.name;
            ASSERT_GE(std::min({d.weight.x, d.weight.y, d.weight.z, d.pdf}), 0) << c.name;
            sum += d.weight;
            squares += d.weight * d.weight;
            largest = std::max({largest, d.weight.x, d.weight.y, d.weight.z});
        }
        const auto count = static_cast<double>(kSamples);
        const Vec3 mean = sum / count;
        const Vec3 error = glm::sqrt(glm::max(squares / count - mean * mean, Vec3(0)) / count);
        RecordProperty(c.name, std::to_string(mean.y));
        EXPECT_LT(largest, 8) << c.name;
        for (int k = 0; k < 3; ++k) {
            EXPECT_LE(mean[k], 1 + c.tolerance + 5 * error[k]) << c.name;
            const double least = c.lossless ? 1 - c.tolerance - 5 * error[k] : 0;
            EXPECT_GE(mean[k], least) << c.name;
        }
    }
}

/// What a case does not call for may be compiled in or not: the bits are the same.
TEST_P(BsdfSampling, SpecialisedIsGeneralBitForBit)
{
    constexpr std::size_t kFew = 1U << 14U;
    for (const BsdfCase& c : GetParam().cases)
        for (const BsdfProbe probe : {BsdfProbe::kSamples, BsdfProbe::kValues}) {
            const auto all = probe_bsdf(c, general_macros(), probe, kFew);
            const auto few = probe_bsdf(c, special(c), probe, kFew);
            EXPECT_EQ(std::memcmp(all.data(), few.data(), all.size() * sizeof all[0]), 0)
                << c.name << " probe " << static_cast<int>(probe);
        }
}

INSTANTIATE_TEST_SUITE_P(Bsdf, BsdfSampling, testing::ValuesIn(bsdf_families()),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
