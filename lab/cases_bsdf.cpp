// Reflection at its limits: smooth and rough, grazing and straight, lossless and total.
#include "lab/evaluate.h"
#include "lab/groups.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr const char* kBsdfHead = R"(
#define FX_ROUGH_REFLECTION 1
#define FX_MIRROR 1
#define FX_DIELECTRIC 1
#define FX_ROUGH_DIELECTRIC 1
#include "bsdf/bsdf.glsl"
vec3 direction(float z, float phi) { return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z); }
ShadedMaterial material(float alpha, float metallic, float transmission, float albedo, bool thin_walled)
{
    ShadedMaterial m;
    m.albedo = vec3(albedo);
    m.emission = vec3(0.0);
    m.shading_normal = vec3(0.0, 0.0, 1.0);
    m.metallic = metallic;
    m.alpha = alpha;
    m.specular = 1.0;
    m.ior = 1.5;
    m.specular_color = vec3(1.0);
    m.transmission = transmission;
    m.thin_walled = thin_walled;
    m.absorption = vec3(0.0);
    m.priority = 0;
    return m;
}
)";

constexpr float kRoughnesses[] = {0, 1e-4F, 0.03F, 0.03125F, 0.03126F, 0.1F, 0.3F, 0.7F, 1};
constexpr float kCosines[] = {0, 1e-7F, 1e-5F, 1e-3F, 0.1F, 0.5F, 0.99999994F, 1};

/// Every roughness with every cosine towards the viewer, every blend of metal, glass and paint.
std::vector<glm::vec4> edges()
{
    std::vector<glm::vec4> rows;
    for (const float roughness : kRoughnesses)
        for (const float cosine : kCosines)
            for (const float metallic : {0.0F, 0.3F, 1.0F})
                for (const float transmission : {0.0F, 0.5F, 1.0F})
                    rows.emplace_back(roughness, cosine, metallic, transmission);
    return rows;
}

/// Values at 18 directions and 33 samples of each: x counts what is not finite or is negative, y is
/// the largest weight, z how far a direction is from unit length.
constexpr const char* kEdges = R"(
    const vec3 wo = direction(x.y, 0.0);
    const float etas[4] = float[](1.0, 1.0000001, 1.5, 1.0 / 2.4);
    const ShadedMaterial m = material(alpha_of(x.x, false), x.z, x.w, row % 7u == 0u ? 0.0 : 1.0, row % 5u == 0u);
    const Bsdf b = make_bsdf(m, vec3(0.0, 0.0, 1.0), wo, etas[row / 11u % 4u]);
    for (int i = -8; i <= 9; ++i) {
        const float z = float(sign(i)) * pow(abs(float(i)) / 8.0, 8.0);
        for (int turn = 0; turn < 2; ++turn) {
            const BsdfValue v = bsdf_evaluate(b, wo, i > 8 ? mirrored(wo) : direction(z, 3.0 * float(turn)));
            const vec3 sum = v.diffuse + v.specular;
            if (!all_finite(sum) || any(lessThan(sum, vec3(0.0))) || !is_finite(v.pdf) || v.pdf < 0.0)
                result.x += 1.0;
        }
    }
    for (int i = 0; i < 33; ++i) {
        const float last = 0.99999994;
        const vec4 u = vec4(i == 0 ? 0.0 : fract(float(i) * 0.618), i == 1 ? last : i == 2 ? 0.0 : fract(float(i) * 0.382),
            0.5, i == 3 ? last : i == 4 ? 0.0 : fract(float(i) * 0.27));
        const BsdfSample s = bsdf_sample(b, wo, u);
        if (!all_finite(s.weight) || any(lessThan(s.weight, vec3(0.0))) || !is_finite(s.pdf) || s.pdf < 0.0
            || !all_finite(s.wi))
            result.x += 1.0;
        else {
            result.y = max(result.y, max_component(s.weight));
            result.z = max(result.z, abs(length(s.wi) - 1.0));
        }
    }
)";

void values_at_the_edges(Findings& findings, Length /*length*/)
{
    float broken = 0;
    float heaviest = 0;
    float length_off = 0;
    for (const glm::vec4& r : evaluate({kBsdfHead, kEdges, {}}, edges())) {
        broken += r.x;
        heaviest = farther(heaviest, r.y);
        length_off = farther(length_off, r.z);
    }
    findings.none("values that are negative or not finite", static_cast<double>(broken));
    findings.at_most("largest weight of a sample", static_cast<double>(heaviest), 4);
    findings.at_most("directions off unit length", static_cast<double>(length_off), 1e-5);
}

/// Single-scattering albedo E(mu) of GGX, F = 1; rows by alpha, columns by cosine. By quadrature in
/// double precision.
constexpr float kTableAlphas[] = {0.001F, 0.1F, 0.25F, 0.5F, 1};
constexpr float kTableCosines[] = {1, 0.7F, 0.3F, 0.1F, 0.05F};
constexpr double kAlbedos[5][5] = {{1, 1, 1, 0.9999, 0.9998},
    {0.9883, 0.9814, 0.9363, 0.8835, 0.9118}, {0.9158, 0.8853, 0.8379, 0.8916, 0.9331},
    {0.6879, 0.6830, 0.7453, 0.8601, 0.9126}, {0.3069, 0.3789, 0.5601, 0.7602, 0.8478}};

/// Visible normals on a Fibonacci lattice, cubed towards the tail, which is all that a smooth
/// surface loses.
constexpr const char* kAlbedo = R"(
    const vec3 wo = vec3(sqrt(1.0 - x.y * x.y), 0.0, x.y);
    const float so = ggx_stretch(wo, x.x);
    float sum = 0.0, weights = 0.0;
    const int n = 987;
    for (int i = 0; i < n; ++i) {
        const float v = (float(i) + 0.5) / float(n);
        const vec3 h = ggx_sample_visible_normal(wo, x.x, vec2(fract(float(i) * 0.38196601), 1.0 - v * v * v));
        const vec3 wi = reflected(wo, h);
        const float g = wi.z > 0.0 ? ggx_shadowing_over_cosine(wo.z, so, wi.z, ggx_stretch(wi, x.x)) : 0.0;
        sum += v * v * g / ggx_visibility(wo.z, so);
        weights += v * v;
    }
    result.x = sum / weights;
)";

/// A test for "at most 1" is blind to a factor of 2; these values are not.
void albedo_of_ggx(Findings& findings, Length /*length*/)
{
    std::vector<glm::vec4> rows;
    for (const float alpha : kTableAlphas)
        for (const float cosine : kTableCosines)
            rows.emplace_back(alpha, cosine, 0, 0);
    const std::vector<glm::vec4> found = evaluate({kBsdfHead, kAlbedo, {}}, rows);
    double off = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        off = farther(off, std::abs(static_cast<double>(found[i].x) - kAlbedos[i / 5][i % 5]));
    findings.at_most("albedo off the table of 25", off, 4e-4);  // four digits, and the lattice
}

void reciprocity(Findings& findings, Length /*length*/)
{
    std::vector<glm::vec4> rows;
    for (int i = 0; i < 60; ++i)
        for (int k = 1; k <= 4; ++k)
            rows.emplace_back(0.02F + 0.016F * static_cast<float>(i),
                0.9F - 0.013F * static_cast<float>(i), 0.3F + 0.1F * static_cast<float>(i),
                0.25F * static_cast<float>(k));
    double off = 0;
    for (const glm::vec4& r : evaluate({kBsdfHead, R"(
    float unused;
    const vec3 a = direction(x.x, 0.3), b = direction(x.y, x.z);
    result.x = ggx_reflection(a, b, x.w, unused).x / b.z;
    result.y = ggx_reflection(b, a, x.w, unused).x / a.z;
)",
                                           {}},
             rows))
        off = farther(off, std::abs(static_cast<double>(r.x) / static_cast<double>(r.y) - 1));
    findings.at_most("f(a, b) / f(b, a) - 1", off, 1e-4);
}

/// Fresnel's equations in double precision; eta: index behind over index before.
double fresnel_oracle(double cos_i, double eta)
{
    const double sin2_t = (1 - cos_i * cos_i) / (eta * eta);
    if (sin2_t >= 1)
        return 1;
    const double cos_t = std::sqrt(1 - sin2_t);
    const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

void fresnel(Findings& findings, Length /*length*/)
{
    std::vector<glm::vec4> rows;
    for (const float eta : {1.5F, 1 / 1.5F, 1.0000001F, 2.4F, 1 / 2.4F, 1.0F})
        for (int i = 0; i <= 4000; ++i)
            rows.emplace_back(static_cast<float>(i) / 4000, eta, 0, 0);
    const auto brewster = static_cast<float>(std::cos(std::atan(1.5)));
    rows.emplace_back(brewster, 1.5F, 0, 0);
    rows.emplace_back(0.0F, 1.0F, 0, 0);
    const std::vector<glm::vec4> found = evaluate(
        {kBsdfHead, "result.xy = vec2(fresnel_dielectric(x.x, x.y), refracted_cosine(x.x, x.y));",
            {}},
        rows);
    double off = 0;
    double outside = 0;
    for (std::size_t i = 0; i + 2 < rows.size(); ++i) {
        const auto value = static_cast<double>(found[i].x);
        const auto refracted = static_cast<double>(found[i].y);
        outside += value >= 0 && value <= 1 && refracted >= 0 && refracted <= 1 ? 0 : 1;
        // Within a ulp of the critical angle the slope has no bound.
        const auto c = static_cast<double>(rows[i].x);
        const auto eta = static_cast<double>(rows[i].y);
        const double below = fresnel_oracle(c - 1e-7, eta);
        const double above = fresnel_oracle(c + 1e-7, eta);
        if (c > 0)
            off = farther(
                off, farther(value - std::max(below, above), std::min(below, above) - value));
    }
    findings.none("reflectances or refracted cosines outside [0, 1], of 24006", outside);
    findings.at_most("off Fresnel's equations", off, 1e-6);
    findings.at_most("off 0.073964 at Brewster's angle",
        std::abs(static_cast<double>(found[rows.size() - 2].x) - 0.0739644970), 1e-6);
}

void heuristic_of_extremes(Findings& findings, Length /*length*/)
{
    std::vector<glm::vec4> rows;
    for (int p = -38; p <= 38; ++p)
        for (int q = -38; q <= 38; ++q)
            rows.emplace_back(std::pow(10.0F, static_cast<float>(p)),
                std::pow(10.0F, static_cast<float>(q)), 0, 0);
    rows.emplace_back(0, 0, 0, 0);
    rows.emplace_back(0, 1, 0, 0);
    const std::vector<glm::vec4> found = evaluate(
        {"#include \"lib/sampling.glsl\"",
            "result = vec4(power_heuristic(x.x, x.y), power_heuristic(x.y, x.x), 0.0, 0.0);", {}},
        rows);
    double off = 0;
    double outside = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto [p, q] =
            std::pair(static_cast<double>(rows[i].x), static_cast<double>(rows[i].y));
        const auto weight = static_cast<double>(found[i].x);
        outside += weight >= 0 && weight <= 1 ? 0 : 1;
        const double expected = p > 0 ? p * p / (p * p + q * q) : 0;
        off = farther(off, std::abs(weight - expected));
        if (p > 0 && q > 0)
            off = farther(off, std::abs(weight + static_cast<double>(found[i].y) - 1));
    }
    findings.none("weights outside [0, 1], of 5931", outside);
    findings.at_most("off p^2 / (p^2 + q^2), or pairs off 1", off, 1e-6);
}

constexpr Case kBsdfCases[] = {
    {"28", "bsdf", "smoothest, roughest and grazing", Layer::kFunction,
        "Values, densities and weights are finite and not negative for roughness from 0 to 1 and "
        "cosines from 0 to 1.",
        values_at_the_edges},
    {"28b", "bsdf", "albedo of GGX", Layer::kFunction,
        "Single-scattering albedo is that of a table by quadrature.", albedo_of_ggx},
    {"31", "bsdf", "reciprocity", Layer::kFunction, "f(a, b) = f(b, a) of the reflecting lobe.",
        reciprocity},
    {"32", "bsdf", "Fresnel's equations", Layer::kFunction,
        "Reflectance is within [0, 1] and Fresnel's, at normal, Brewster's, grazing and critical "
        "angles.",
        fresnel},
    {"36", "bsdf", "heuristic of extreme densities", Layer::kFunction,
        "The power heuristic of densities from 1e-38 to 1e38, or 0, is a weight.",
        heuristic_of_extremes},
};

constexpr Guard kBsdfGuards[] = {
    {"heuristic_as_ratio", "36", "lib/sampling.glsl", "1.0 / (1.0 + ratio * ratio) : 0.0;",
        "p * p / (p * p + q * q) : 0.0;"},
    {"heuristic_of_nothing", "36", "lib/sampling.glsl",
        "return p > 0.0 ? 1.0 / (1.0 + ratio * ratio) : 0.0;",
        "return 1.0 / (1.0 + ratio * ratio);"},
    {"viewer_above_horizon", "28", "bsdf/lobe.glsl", "max(wo.z, 5.9604645e-8)", "wo.z"},
    {"weight_by_reflectance", "28", "bsdf/interface.glsl",
        "average(s.tint + (1.0 - s.tint) * reflectance(s, cos_o));",
        "average(max(s.tint, vec3(f0)));"},
    {"total_reflection", "32", "bsdf/fresnel.glsl",
        "sqrt(max(0.0, (eta - 1.0) * (eta + 1.0) + cos_i * cos_i))",
        "sqrt((eta - 1.0) * (eta + 1.0) + cos_i * cos_i)"},
    {"fresnel_at_the_horizon", "32", "bsdf/fresnel.glsl",
        "return cos_t > 0.0 && cos_i > 0.0 ? min(f, 1.0) : 1.0;", "return f;"},
    {"ggx_without_cancellation", "28b", "bsdf/ggx.glsl",
        "precise const float k = u.y * (1.0 + w.z);  // 1 - z on the cap, without cancellation",
        "precise const float k = 2.0 * u.y * w.z;"},
    {"ggx_correlated_shadowing", "28b 31", "bsdf/ggx.glsl",
        "precise const float g = 2.0 * z_i / (z_o * stretch_i + z_i * stretch_o);",
        "precise const float g = 2.0 * z_i / (z_i * stretch_i + z_i * stretch_o);"},
};

}  // namespace

Group bsdf_group()
{
    return {kBsdfCases, kBsdfGuards};
}

}  // namespace farlight::lab
