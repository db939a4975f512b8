// Every lobe and mixture of bsdf/bsdf.glsl: samples follow the density that is claimed
// (chi-squared), and materials that absorb nothing lose nothing (white furnace).
//
// Seeds are fixed, so the tests are deterministic. With fresh seeds one of all chi-squared tests
// would fail by chance once in 100 runs (Sidak), a furnace test once in 1.7 million (5 standard
// errors).
#include "lab/compute.h"
#include "lab/statistics.h"
#include "server/gl/buffer.h"
#include "server/scene/albedo_tables.h"
#include "server/scene/effects.h"
#include "tests/shaders/bsdf_cases.h"
#include "tests/support/gl_test.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numbers>

namespace farlight {
namespace {

using Vec3 = glm::dvec3;

constexpr std::size_t kSamples = 1U << 17U;

constexpr std::size_t kRings = 24;
constexpr std::size_t kSectors = 16;
constexpr std::size_t kBins = 2 * kRings * kSectors;

Vec3 viewer(const BsdfCase& c)
{
    return {std::sqrt(1 - c.cosine * c.cosine), 0, c.cosine};
}

double eta_of(const BsdfCase& c)
{
    return c.inside ? 1.0 / static_cast<double>(c.material.ior)
                    : static_cast<double>(c.material.ior);
}

Vec3 geometric_normal(const BsdfCase& c)
{
    return glm::normalize(Vec3(c.tilt, 1));
}

/// Axes of the histogram: where the sharpest lobes point, above and below.
Vec3 axis(const BsdfCase& c, bool above)
{
    const Vec3 wo = viewer(c);
    // On the horizon itself the bins' edges run along it, so that none is cut thin.
    if (above)
        return c.cosine < 0.05 ? Vec3(-1, 0, 0) : Vec3(-wo.x, 0, wo.z);
    const double eta = c.material.thin_walled ? 1 : eta_of(c);
    const double sine = std::min(wo.x / eta, 1.0);
    return {-sine, 0, -std::sqrt(1 - sine * sine)};
}

/// How wide the sharpest lobe is, in units of sin(angle / 2).
double scale(const BsdfCase& c)
{
    const Material& m = c.material;
    double roughness = 1;
    const auto sharpen = [&](float r) {
        if (r > MIRROR_ROUGHNESS)
            roughness = std::min<double>(roughness, r);
    };
    if (m.metallic > 0 || m.specular > 0 || m.transmission > 0)
        sharpen(m.roughness);
    if (m.clearcoat > 0)
        sharpen(m.clearcoat_roughness);
    const bool bends = m.transmission > 0 && !m.thin_walled && eta_of(c) != 1;
    return 0.5 * roughness * roughness * (bends ? std::min(1.0, std::abs(eta_of(c) - 1)) : 1);
}

std::vector<glm::vec4> parameters(const BsdfCase& c, float seed)
{
    const Material& m = c.material;
    const auto s = static_cast<float>(scale(c));
    return {{m.albedo, m.metallic}, {m.roughness, m.specular, eta_of(c), m.transmission},
        {m.specular_color, m.thin_walled ? 1 : 0},
        {m.clearcoat, m.clearcoat_roughness, c.cosine, 0}, {glm::vec3(geometric_normal(c)), seed},
        {c.coat_tilt, kRings, kSectors}, {glm::vec3(axis(c, true)), s},
        {glm::vec3(axis(c, false)), s}};
}

struct Drawn {
    Vec3 wi;
    Vec3 weight;
    double pdf = 0;
    bool usable = false;
    bool delta = false;
};

class BsdfSampling : public GlTest, public testing::WithParamInterface<BsdfFamily> {
protected:
    using Macros = std::vector<std::string_view>;

    static const Program& program(const Macros& macros, const char* mode)
    {
        static std::map<std::pair<Macros, std::string>, std::unique_ptr<Program>> programs;
        std::unique_ptr<Program>& known = programs[{macros, mode}];
        if (known == nullptr) {
            add_shader_file("tests/bsdf_probe",
                read_text(FARLIGHT_SOURCE_DIR "/tests/shaders/bsdf_probe.comp"));
            Defines defines{{mode, "1"}};
            for (const std::string_view macro : macros)
                defines.emplace_back(macro, "1");
            known = std::make_unique<Program>(load_shader_source("tests/bsdf_probe", defines));
        }
        return *known;
    }
    static Macros general() { return EffectMask::general().macros(); }
    /// What the case calls for alone.
    static Macros special(const BsdfCase& c)
    {
        const Material& m = c.material;
        const bool sharp = m.roughness <= MIRROR_ROUGHNESS;
        Macros macros;
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
    static std::vector<glm::vec4> run(
        const BsdfCase& c, const Program& on, std::size_t outputs, std::size_t invocations)
    {
        static Buffer reflection("reflection_albedo", bytes_of(reflection_albedo_table()));
        static Buffer dielectric("dielectric_albedo", bytes_of(dielectric_albedo_table()));
        const std::vector<glm::vec4> values = parameters(c, 1);
        Buffer probe("probe", std::as_bytes(std::span<const glm::vec4>(values)));
        const Inputs inputs{{"probe", probe.texture(GL_RGBA32UI)},
            {"reflection_albedo", reflection.texture(GL_RGBA32UI)},
            {"dielectric_albedo", dielectric.texture(GL_RGBA32UI)}};
        return run_compute(on, inputs, outputs, invocations);
    }
    static std::span<const std::byte> bytes_of(const Texels& texels)
    {
        return std::as_bytes(std::span<const glm::uvec4>(texels));
    }
    static std::vector<Drawn> draw(const BsdfCase& c)
    {
        const std::vector<glm::vec4> texels =
            run(c, program(general(), "PROBE_SAMPLES"), 2 * kSamples, kSamples);
        std::vector<Drawn> drawn(kSamples);
        for (std::size_t i = 0; i < kSamples; ++i) {
            const glm::vec4& direction = texels[2 * i];
            const glm::vec4& weight = texels[2 * i + 1];
            drawn[i] = {Vec3(direction), Vec3(weight), weight.w, direction.w > 0, direction.w == 2};
        }
        return drawn;
    }
    static std::size_t bin_of(const BsdfCase& c, const Vec3& wi)
    {
        const bool above = glm::dot(wi, geometric_normal(c)) > 0;
        const Vec3 a = glm::dvec3(glm::vec3(axis(c, above)));
        // Duff et al. 2017, as in lib/sampling.glsl.
        const double sign = a.z >= 0 ? 1 : -1;
        const double k = -1 / (sign + a.z);
        const Vec3 x(1 + sign * a.x * a.x * k, sign * a.x * a.y * k, -sign * a.x);
        const Vec3 y(a.x * a.y * k, sign + a.y * a.y * k, -a.y);
        const double rho = std::min(0.5 * glm::length(wi - a), 1.0);
        const double s = scale(c);
        const double radius = std::log1p(rho / s) / std::log1p(1 / s);
        const double turn = std::atan2(glm::dot(wi, y), glm::dot(wi, x)) / (2 * std::numbers::pi);
        const auto ring =
            std::min<std::size_t>(static_cast<std::size_t>(radius * kRings), kRings - 1);
        const auto sector = std::min<std::size_t>(
            static_cast<std::size_t>((turn - std::floor(turn)) * kSectors), kSectors - 1);
        return ((above ? 0 : kRings) + ring) * kSectors + sector;
    }
};

TEST_P(BsdfSampling, SamplesFollowTheirDensity)
{
    const double threshold = 1 - std::pow(0.99, 1.0 / 200);
    for (const BsdfCase& c : GetParam().cases) {
        const std::vector<glm::vec4> integrals =
            run(c, program(general(), "PROBE_DENSITY"), kBins, kBins);
        std::vector<double> expected(kBins + 1);
        std::vector<double> found(kBins + 1);
        double total = 0;
        for (std::size_t i = 0; i < kBins; ++i) {
            expected[i] = kSamples * static_cast<double>(integrals[i].x);
            total += static_cast<double>(integrals[i].x);
        }
        for (const Drawn& d : draw(c))
            found[d.usable && !d.delta ? bin_of(c, d.wi) : kBins] += 1;
        // What is lost into the surface or taken by a delta lobe.
        expected[kBins] = kSamples * std::max(0.0, 1 - total);
        EXPECT_LT(total, 1.001) << c.name;
        EXPECT_GT(chi_squared_p_value(expected, found), threshold)
            << c.name << ": density integrates to " << total;
    }
}

TEST_P(BsdfSampling, WhiteFurnace)
{
    for (const BsdfCase& c : GetParam().cases) {
        Vec3 sum(0);
        Vec3 squares(0);
        double largest = 0;
        for (const Drawn& d : draw(c)) {
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
        for (const char* mode : {"PROBE_SAMPLES", "PROBE_VALUES"}) {
            const auto all = run(c, program(general(), mode), 2 * kFew, kFew);
            const auto few = run(c, program(special(c), mode), 2 * kFew, kFew);
            EXPECT_EQ(std::memcmp(all.data(), few.data(), all.size() * sizeof all[0]), 0)
                << c.name << " " << mode;
        }
}

INSTANTIATE_TEST_SUITE_P(Bsdf, BsdfSampling, testing::ValuesIn(bsdf_families()),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
