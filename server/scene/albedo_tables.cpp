// Quadrature over visible normals, in double precision: the integrand is then shadowing and Fresnel
// alone, which are smooth. Formulas as in shaders/bsdf/ggx.glsl; the tests compare both with
// published values.
#include "server/scene/albedo_tables.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace farlight {
namespace {

using Vec3 = glm::dvec3;

double stretch(const Vec3& w, double alpha)
{
    return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

Vec3 viewer(double cos_o)
{
    return {std::sqrt(std::max(0.0, 1 - cos_o * cos_o)), 0, cos_o};
}

/// Mean of `integrand(normal)` over the normals visible from `wo`, which is symmetric in y.
/// Source: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
template <typename Integrand>
glm::dvec2 mean_over_visible_normals(
    const Vec3& wo, double alpha, int samples, const Integrand& integrand)
{
    const Vec3 w = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
    glm::dvec2 sum(0);
    double weights = 0;
    for (int i = 0; i < samples; ++i) {
        // A lattice, because the edges of total reflection run along no axis of a grid.
        const double phi = std::numbers::pi * std::fmod(i * std::numbers::phi, 1.0);
        // Of a smooth surface only the distribution's tail loses light: samples are cubed towards
        // it.
        const double v = (i + 0.5) / samples;
        const double k = (1 - v * v * v) * (1 + w.z);
        const double sine = std::sqrt(k * (2 - k));
        const Vec3 cap(sine * std::cos(phi) + w.x, sine * std::sin(phi), (1 + w.z) * v * v * v);
        sum += v * v * integrand(glm::normalize(Vec3(alpha * cap.x, alpha * cap.y, cap.z)));
        weights += v * v;
    }
    return sum / weights;
}

/// G2 / G1(wo) for directions on either side; `z` is the distance of wi's cosine from the horizon.
double shadowing(const Vec3& wo, const Vec3& wi, double alpha)
{
    const double z = std::abs(wi.z);
    const double so = stretch(wo, alpha);
    return z * (wo.z + so) / (wo.z * stretch(wi, alpha) + z * so);
}

double fresnel(double cos_i, double eta)
{
    const double cos2_t = 1 - (1 - cos_i * cos_i) / (eta * eta);
    if (cos2_t <= 0)
        return 1;
    const double cos_t = std::sqrt(cos2_t);
    const double parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    const double perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

constexpr int kReflectionSamples = 1597;
// Total reflection from inside has edges that take more samples.
constexpr int kDielectricSamples = 610;
constexpr int kInsideSamples = 1597;

/// Alpha of a node on the axis of perceptual roughness; at 0 the limit, which is reached here.
double alpha_at(double roughness)
{
    return std::max(roughness * roughness, 1e-6);
}

/// The inverse of albedo_coordinate() in bsdf/albedo_table.glsl, off the horizon itself.
double cosine_at(double coordinate, double alpha)
{
    const double root = 0.5 * (std::sqrt(1 + 8 * coordinate) - 1);
    const double t = root * root;
    return std::clamp(alpha * t / (1 + alpha - t), 1e-9, 1.0);
}

/// Cells with their four corners from `value(x, y)` on nodes over [0, 1]^2; x runs fastest.
void append_cells(Texels& texels, int nodes, const std::function<double(double, double)>& value)
{
    const auto count = static_cast<std::size_t>(nodes);
    const double last = nodes - 1;
    std::vector<float> at;
    at.reserve(count * count);
    for (int j = 0; j < nodes; ++j)
        for (int i = 0; i < nodes; ++i)
            at.push_back(static_cast<float>(value(i / last, j / last)));
    for (std::size_t j = 0; j + 1 < count; ++j)
        for (std::size_t i = 0; i + 1 < count; ++i) {
            const float* corner = &at[j * count + i];
            texels.push_back(glm::floatBitsToUint(
                glm::vec4(corner[0], corner[1], corner[count], corner[count + 1])));
        }
}

Texels integrate_reflection()
{
    Texels texels;
    append_cells(texels, ALBEDO_NODES, [](double coordinate, double roughness) {
        const double alpha = alpha_at(roughness);
        return reflection_albedo(cosine_at(coordinate, alpha), alpha).total;
    });
    append_cells(texels, ALBEDO_NODES, [](double root, double roughness) {
        const double cosine = std::max(root * root, 1e-9);
        const double schlick = reflection_albedo(cosine, alpha_at(roughness)).schlick;
        return std::pow(schlick, 0.2) - (1 - cosine);
    });
    return texels;
}

Texels integrate_dielectric()
{
    Texels texels;
    for (int k = 0; k < DIELECTRIC_ETA_NODES; ++k) {
        const double contrast = DIELECTRIC_CONTRAST * (2.0 * k / (DIELECTRIC_ETA_NODES - 1) - 1);
        const double eta = (1 + contrast) / (1 - contrast);
        append_cells(texels, DIELECTRIC_NODES, [eta](double coordinate, double roughness) {
            const double alpha = alpha_at(roughness);
            return dielectric_albedo(cosine_at(coordinate, alpha), alpha, eta);
        });
    }
    return texels;
}

}  // namespace

ReflectionAlbedo reflection_albedo(double cos_o, double alpha)
{
    const Vec3 wo = viewer(cos_o);
    const glm::dvec2 sum =
        mean_over_visible_normals(wo, alpha, kReflectionSamples, [&](const Vec3& h) {
            const double cos_h = std::min(glm::dot(wo, h), 1.0);
            const Vec3 wi = 2 * cos_h * h - wo;
            const double weight = wi.z > 0 ? shadowing(wo, wi, alpha) : 0;
            return weight * glm::dvec2(1, std::pow(1 - cos_h, 5));
        });
    return {sum.x, sum.y / sum.x};
}

double dielectric_albedo(double cos_o, double alpha, double eta)
{
    const Vec3 wo = viewer(cos_o);
    const auto scattered = [&](const Vec3& h) {
        const double cos_h = std::min(glm::dot(wo, h), 1.0);
        const double f = fresnel(cos_h, eta);
        const Vec3 up = 2 * cos_h * h - wo;
        const double reflected = up.z > 0 ? f * shadowing(wo, up, alpha) : 0;
        const double cos2_t = 1 - (1 - cos_h * cos_h) / (eta * eta);
        if (cos2_t <= 0)
            return glm::dvec2(reflected, 0);
        const Vec3 down = (cos_h / eta - std::sqrt(cos2_t)) * h - wo / eta;
        return glm::dvec2(reflected, down.z < 0 ? (1 - f) * shadowing(wo, down, alpha) : 0);
    };
    const glm::dvec2 parts = mean_over_visible_normals(
        wo, alpha, eta < 1 ? kInsideSamples : kDielectricSamples, scattered);
    return parts.x + parts.y;
}

const Texels& reflection_albedo_table()
{
    static const Texels table = integrate_reflection();
    return table;
}

const Texels& dielectric_albedo_table()
{
    static const Texels table = integrate_dielectric();
    return table;
}

}  // namespace farlight
