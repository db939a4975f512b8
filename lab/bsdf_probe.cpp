// The probe's shader, its parameters and its bins.
#include "lab/bsdf_probe.h"

#include "lab/compute.h"
#include "lab/statistics.h"
#include "server/gl/buffer.h"
#include "server/scene/albedo_tables.h"
#include "server/scene/effects.h"
#include "shaders/shared/scene_layout.h"

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

namespace farlight {
namespace {

constexpr std::size_t kRings = 24;
constexpr std::size_t kSectors = 16;
constexpr std::size_t kBins = 2 * kRings * kSectors;

/// What `probe` holds: parameters().
constexpr const char* kProbeShader = R"(#version 450
#include "bsdf/bsdf.glsl"
#include "lib/random.glsl"

layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer probe;

vec4 parameter(int at) { return uintBitsToFloat(texelFetch(probe, at)); }

float alpha_of_probe(float roughness) { return roughness > MIRROR_ROUGHNESS ? roughness * roughness : 0.0; }

Bsdf probed(out vec3 wo)
{
    const vec4 a = parameter(0), b = parameter(1), c = parameter(2), d = parameter(3), e = parameter(4);
    ShadedMaterial m;
    m.albedo = a.rgb;
    m.emission = vec3(0.0);
    m.shading_normal = vec3(0.0, 0.0, 1.0);
#ifdef FX_UNLIT
    m.unlit = false;
#endif
#if defined(FX_ROUGH_REFLECTION) || defined(FX_MIRROR) || defined(FX_DIELECTRIC)
    m.metallic = a.w;
    m.alpha = alpha_of_probe(b.x);
    m.specular = b.y;
    m.ior = max(b.z, 1.0 / b.z);
    m.specular_color = c.rgb;
#endif
#ifdef FX_DIELECTRIC
    m.transmission = b.w;
    m.thin_walled = c.w != 0.0;
    m.absorption = vec3(0.0);
    m.priority = 0;
#endif
#ifdef FX_CLEARCOAT
    m.clearcoat = d.x;
    m.clearcoat_alpha = alpha_of_probe(d.y);
    m.clearcoat_normal = normalize(vec3(parameter(5).xy, 1.0));
#endif
    wo = vec3(sqrt(max(0.0, 1.0 - d.z * d.z)), 0.0, d.z);
    return make_bsdf(m, e.xyz, wo, b.z);
}

#ifdef PROBE_DENSITY
// Bins around an axis on either side of the surface. Their radius x in [0, 1] grows with the logarithm of the angle:
// sin(angle / 2) = scale * ((1 + 1 / scale)^x - 1).
void main()
{
    const uint bin = gl_GlobalInvocationID.x;
    vec3 wo;
    const Bsdf b = probed(wo);
    const uint rings = uint(parameter(5).z), sectors = uint(parameter(5).w);
    const bool above = bin < rings * sectors;
    const vec4 axis = parameter(above ? 6 : 7);
    const uint inside = bin % (rings * sectors);
    const vec2 corner = vec2(inside / sectors, inside % sectors);
    const mat3 frame = basis_around(axis.xyz);
    const vec3 geometric_normal = parameter(4).xyz;
    const float decades = log(1.0 + 1.0 / axis.w);
    const int parts = int(parameter(3).w);  // along each side of a bin
    vec4 sum = vec4(0.0);
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) {
            const vec2 x = (corner + (vec2(i, j) + 0.5) / float(parts)) / vec2(rings, sectors);
            const float rho = axis.w * (exp(x.x * decades) - 1.0);
            const float measure = 4.0 * rho * (axis.w + rho) * decades * 2.0 * PI;
            const float sin_theta = 2.0 * rho * sqrt(max(0.0, 1.0 - rho * rho));
            const float phi = 2.0 * PI * x.y;
            const vec3 wi = frame * vec3(sin_theta * cos(phi), sin_theta * sin(phi), 1.0 - 2.0 * rho * rho);
            const BsdfValue v = bsdf_evaluate(b, wo, wi);
            const bool counts = (dot(geometric_normal, wi) > 0.0) == above;
            if (counts)
                sum += measure * vec4(v.pdf, v.diffuse + v.specular);
        }
    results[bin] = sum / float(rings * sectors * uint(parts * parts));
}
#elif defined(PROBE_VALUES)
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    vec3 wo;
    const Bsdf b = probed(wo);
    const vec2 u = random4(uvec2(i, 1u), 1u, 0u, 0u, SLOT_LIGHT).xy;
    const BsdfValue v = bsdf_evaluate(b, wo, sample_cone(u, 2.0));
    results[2u * i] = vec4(v.diffuse, v.pdf);
    results[2u * i + 1u] = vec4(v.specular, 0.0);
}
#else
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    vec3 wo;
    const Bsdf b = probed(wo);
    const vec4 u = random4(uvec2(i, 0u), 1u, 0u, 0u, SLOT_BSDF);
    const BsdfSample s = bsdf_sample(b, wo, u);
    const bool usable = max_component(s.weight) > 0.0;
#ifdef PROBE_AGREEMENT
    const BsdfValue v = bsdf_evaluate(b, wo, s.wi);
    const vec3 value = v.diffuse + v.specular;
    const float off = max_component(abs(s.weight * v.pdf - value)) / max_component(value);
    const float none = 2.0;
    float rarest = b.p_diffuse > 0.0 ? b.p_diffuse : none;
    rarest = min(rarest, b.p_reflection > 0.0 ? b.p_reflection : none);
    rarest = min(rarest, b.p_interface > 0.0 ? b.p_interface : none);
    rarest = min(rarest, b.p_coat > 0.0 ? b.p_coat : none);
    const bool broken = !all_finite(s.weight) || !is_finite(s.pdf) || !all_finite(s.wi)
        || any(lessThan(s.weight, vec3(0.0))) || s.pdf < 0.0;
    results[i] = vec4(usable && !s.delta ? off : 0.0, max_component(s.weight), rarest, broken ? 1.0 : 0.0);
#else
    results[2u * i] = vec4(s.wi, usable ? (s.delta ? 2.0 : 1.0) : 0.0);
    results[2u * i + 1u] = vec4(s.weight, s.pdf);
#endif
}
#endif
)";

using Vec3 = glm::dvec3;

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

/// Axes of the bins: where the sharpest lobes point, above and below.
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

std::vector<glm::vec4> parameters(const BsdfCase& c)
{
    const Material& m = c.material;
    const auto s = static_cast<float>(scale(c));
    const float parts = c.cosine < 0.05 ? 32 : 16;  // grazing, lobes are thinner than their bins
    return {{m.albedo, m.metallic}, {m.roughness, m.specular, eta_of(c), m.transmission},
        {m.specular_color, m.thin_walled ? 1 : 0},
        {m.clearcoat, m.clearcoat_roughness, c.cosine, parts}, {glm::vec3(geometric_normal(c)), 0},
        {c.coat_tilt, kRings, kSectors}, {glm::vec3(axis(c, true)), s},
        {glm::vec3(axis(c, false)), s}};
}

const Program& program(const BsdfMacros& macros, const char* mode)
{
    static std::map<std::pair<BsdfMacros, std::string>, std::unique_ptr<Program>> programs;
    std::unique_ptr<Program>& known = programs[{macros, mode}];
    if (known == nullptr) {
        add_shader_file("lab/bsdf_probe", kProbeShader);
        Defines defines{{mode, "1"}};
        for (const std::string_view macro : macros)
            defines.emplace_back(macro, "1");
        known = std::make_unique<Program>(load_shader_source("lab/bsdf_probe", defines));
    }
    return *known;
}

std::span<const std::byte> bytes_of(const Texels& texels)
{
    return std::as_bytes(std::span<const glm::uvec4>(texels));
}

std::size_t bin_of(const BsdfCase& c, const Vec3& wi)
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
    const auto ring = std::min<std::size_t>(static_cast<std::size_t>(radius * kRings), kRings - 1);
    const auto sector = std::min<std::size_t>(
        static_cast<std::size_t>((turn - std::floor(turn)) * kSectors), kSectors - 1);
    return ((above ? 0 : kRings) + ring) * kSectors + sector;
}

}  // namespace

BsdfMacros general_macros()
{
    return EffectMask::general().macros();
}

std::vector<glm::vec4> probe_bsdf(
    const BsdfCase& c, const BsdfMacros& macros, BsdfProbe probe, std::size_t count)
{
    static constexpr const char* kModes[] = {
        "PROBE_SAMPLES", "PROBE_VALUES", "PROBE_AGREEMENT", "PROBE_DENSITY"};
    static Buffer reflection("reflection_albedo", bytes_of(reflection_albedo_table()));
    static Buffer dielectric("dielectric_albedo", bytes_of(dielectric_albedo_table()));
    const std::vector<glm::vec4> values = parameters(c);
    Buffer buffer("probe", std::as_bytes(std::span<const glm::vec4>(values)));
    const Inputs inputs{{"probe", buffer.texture(GL_RGBA32UI)},
        {"reflection_albedo", reflection.texture(GL_RGBA32UI)},
        {"dielectric_albedo", dielectric.texture(GL_RGBA32UI)}};
    const bool pairs = probe == BsdfProbe::kSamples || probe == BsdfProbe::kValues;
    return run_compute(program(macros, kModes[static_cast<std::size_t>(probe)]), inputs,
        pairs ? 2 * count : count, count);
}

std::vector<BsdfDraw> draw_bsdf(const BsdfCase& c, std::size_t count)
{
    const std::vector<glm::vec4> texels =
        probe_bsdf(c, general_macros(), BsdfProbe::kSamples, count);
    std::vector<BsdfDraw> drawn(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4& direction = texels[2 * i];
        const glm::vec4& weight = texels[2 * i + 1];
        drawn[i] = {Vec3(direction), Vec3(weight), weight.w, direction.w > 0, direction.w == 2};
    }
    return drawn;
}

BsdfFit fit_of_samples(const BsdfCase& c, std::size_t count)
{
    const std::vector<glm::vec4> integrals =
        probe_bsdf(c, general_macros(), BsdfProbe::kDensity, kBins);
    const auto samples = static_cast<double>(count);
    std::vector<double> expected(kBins + 1);
    std::vector<double> found(kBins + 1);
    BsdfFit fit;
    for (std::size_t i = 0; i < kBins; ++i) {
        expected[i] = samples * static_cast<double>(integrals[i].x);
        fit.total += static_cast<double>(integrals[i].x);
    }
    for (const BsdfDraw& d : draw_bsdf(c, count))
        found[d.usable && !d.delta ? bin_of(c, d.wi) : kBins] += 1;
    // What is lost into the surface or taken by a delta lobe.
    expected[kBins] = samples * std::max(0.0, 1 - fit.total);
    fit.p_value = chi_squared_p_value(expected, found);
    return fit;
}

}  // namespace farlight
