// Samplers against the densities that they claim, and what their weights may at most be.
//
// Seeds are fixed. With fresh ones a chi-squared test would fail by chance once in 100 runs of all
// (Sidak).
#include "lab/bsdf_probe.h"
#include "lab/groups.h"

#include <cmath>

namespace farlight::lab {
namespace {

constexpr std::size_t kBsdfTests = 250;  // that there are, at most

struct Weights {
    double off = 0;  ///< |weight * pdf / value - 1|
    double over_rarest = 0;  ///< Weight times the probability of the rarest lobe.
    double largest = 0;
    double broken = 0;  ///< Count.
};

void weigh(Weights& all, const BsdfCase& c, std::size_t count)
{
    for (const glm::vec4& r : probe_bsdf(c, general_macros(), BsdfProbe::kAgreement, count)) {
        all.off = farther(all.off, static_cast<double>(r.x));
        all.over_rarest = farther(all.over_rarest, static_cast<double>(r.y) * r.z);
        all.largest = farther(all.largest, static_cast<double>(r.y));
        all.broken += static_cast<double>(r.w);
    }
}

void samples_follow_density(Findings& findings, std::string_view family, Length length)
{
    Weights weights;
    double least = 1;
    double beyond = 0;
    std::string where;
    for (const BsdfFamily& f : bsdf_families()) {
        if (f.name != family)
            continue;
        for (const BsdfCase& c : f.cases) {
            const BsdfFit fit = fit_of_samples(c, length == Length::kLong ? 1U << 20U : 1U << 16U);
            weigh(weights, c, 1U << 12U);
            where = fit.p_value >= least ? where : c.name;
            least = fit.p_value >= least ? least : fit.p_value;
            beyond = farther(beyond, fit.total - 1);
        }
    }
    findings.at_least("least p-value of chi-squared, of " + where, least,
        1 - std::pow(0.99, 1.0 / static_cast<double>(kBsdfTests)));
    findings.at_most("what a density integrates to beyond 1", beyond, 1e-3);
    findings.at_most("weight * pdf off the value", weights.off, 1e-3);
    findings.none("weights and densities that are negative or not finite", weights.broken);
}

void metal_samples(Findings& findings, Length length)
{
    samples_follow_density(findings, "Metal", length);
}
void plastic_samples(Findings& findings, Length length)
{
    samples_follow_density(findings, "Plastic", length);
}
void glass_samples(Findings& findings, Length length)
{
    samples_follow_density(findings, "Glass", length);
}
void glass_samples_from_inside(Findings& findings, Length length)
{
    samples_follow_density(findings, "GlassInside", length);
}
void coat_samples(Findings& findings, Length length)
{
    samples_follow_density(findings, "Coated", length);
}
void mixed_samples(Findings& findings, Length length)
{
    samples_follow_density(findings, "Lambert", length);
    samples_follow_density(findings, "Mixtures", length);
}
void leaning_samples(Findings& findings, Length length)
{
    samples_follow_density(findings, "Leaning", length);
}

void rare_lobes(Findings& findings, Length length)
{
    Weights weights;
    for (const BsdfCase& c : bsdfs_of_rare_lobes())
        weigh(weights, c, length == Length::kLong ? 1U << 18U : 1U << 13U);
    for (const BsdfFamily& family : bsdf_families())
        for (const BsdfCase& c : family.cases)
            weigh(weights, c, 1U << 10U);
    findings.none("weights and densities that are negative or not finite", weights.broken);
    // What a rough lobe loses between its facets, at most 1 - 0.3069 (GGX of alpha 1, straight on),
    // is given back to what is left. Lobes are chosen by the mean of three channels.
    findings.at_most(
        "largest weight times the rarest lobe's probability", weights.over_rarest, 1 / 0.3069);
    findings.at_most("largest weight", weights.largest, 3 / 0.3069);
    findings.at_most("weight * pdf off the value", weights.off, 1e-3);
}

constexpr Case kSamplersCases[] = {
    {"29", "samplers", "samples of metal", Layer::kFunction,
        "Samples of a metal follow their density, smooth and rough, straight on and grazing.",
        metal_samples},
    {"29b", "samplers", "samples of plastic", Layer::kFunction,
        "Samples of a diffuse layer under gloss follow their density.", plastic_samples},
    {"29c", "samplers", "samples of glass", Layer::kFunction,
        "Reflected and refracted samples of glass follow their density.", glass_samples},
    {"29d", "samplers", "samples of glass from inside", Layer::kFunction,
        "Likewise from inside, up to and beyond total reflection.", glass_samples_from_inside},
    {"29e", "samplers", "samples of a coat", Layer::kFunction,
        "Samples of a coat over a diffuse layer follow their density.", coat_samples},
    {"29f", "samplers", "samples of mixtures", Layer::kFunction,
        "Samples of several lobes at once follow their density.", mixed_samples},
    {"29g", "samplers", "samples in leaning frames", Layer::kFunction,
        "Samples around a normal that is not the surface's follow their density.", leaning_samples},
    {"30", "samplers", "rare lobes", Layer::kFunction,
        "However unlikely a lobe, a sample's weight is finite and at most one over that chance.",
        rare_lobes},
};

constexpr Guard kSamplersGuards[] = {
    {"reflected_density", "29", "bsdf/lobe.glsl",
        "precise const float d = 0.25 * ggx_distribution(h, alpha);",
        "precise const float d = 0.26 * ggx_distribution(h, alpha);"},
    {"diffuse_density", "29b", "bsdf/bsdf.glsl", "pdf += b.p_diffuse * diffuse_pdf(wi.z);",
        "pdf += b.p_diffuse * 0.5 * INV_PI;"},
    {"refraction_jacobian", "29c 29d", "bsdf/interface.glsl",
        "precise const float root = s.eta / (o_h + s.eta * i_h);",
        "precise const float root = 1.0 / (o_h + s.eta * i_h);"},
    {"coat_in_density", "29e 29g", "bsdf/bsdf.glsl", "pdf += b.p_coat * coat.pdf;", ""},
    {"lobes_add_up", "29f", "bsdf/bsdf.glsl", "pdf += b.p_interface * surface.pdf;",
        "pdf = b.p_interface * surface.pdf;"},
    {"share_of_nothing", "30", "bsdf/bsdf.glsl",
        "return weight == total ? (total > 0.0 ? 1.0 : 0.0) : weight / total;",
        "return weight / total;"},
    {"chosen_by_albedo", "30", "bsdf/bsdf.glsl", "b.p_reflection = share(w_reflection, total);",
        "b.p_reflection = share(w_reflection * w_reflection, total);"},
    {"folded_at_the_surface", "29g", "bsdf/bsdf.glsl",
        "bool more = reaches_across(b, folded, above);", "bool more = false;"},
};

}  // namespace

Group samplers_group()
{
    return {kSamplersCases, kSamplersGuards};
}

}  // namespace farlight::lab
