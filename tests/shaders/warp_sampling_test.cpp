// Warps of lib/sampling.glsl and media/fog.glsl: what follows the density that is claimed is
// uniform once the density's own distribution function is taken of it (chi-squared).
//
// Seeds are fixed, so the tests are deterministic. With fresh seeds one of all would fail by chance
// once in 1000 runs (Bonferroni).
#include "lab/compute.h"
#include "lab/statistics.h"
#include "server/gl/buffer.h"
#include "tests/support/gl_test.h"

#include <functional>
#include <numbers>
#include <optional>

namespace farlight {
namespace {

constexpr std::size_t kWarpSamples = 1U << 17U;
constexpr std::size_t kWarpRows = 32;
constexpr std::size_t kWarpColumns = 8;

/// Both in [0, 1) and, if the warp keeps its word, uniform and independent; nothing for a sample
/// that counts among the rest.
using Uniform = std::function<std::optional<glm::dvec2>(const glm::dvec4&)>;

struct WarpCase {
    const char* name;
    const char* warp;  ///< GLSL, see warp_probe.comp.
    glm::vec4 p{0};
    glm::vec4 q{0};
    Uniform uniform;
    double rest = 0;  ///< Probability of none.

    friend void PrintTo(const WarpCase& c, std::ostream* out) { *out << c.name; }
};

double turn_of(double x, double y)
{
    const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
    return turn - std::floor(turn);
}

WarpCase cone(const char* name, float one_minus_cos)
{
    return {name, "vec4(sample_cone(u, p.x), 0.0)", glm::vec4(one_minus_cos), {},
        [=](const glm::dvec4& w) {
            // From the sine where 1 - z would cancel.
            const double sine2 = w.x * w.x + w.y * w.y;
            const double opening = w.z > 0 ? sine2 / (1 + w.z) : 1 - w.z;
            return glm::dvec2(opening / static_cast<double>(one_minus_cos), turn_of(w.x, w.y));
        }};
}

/// Henyey and Greenstein 1941, integrated up to a cosine.
double phase_below(double cosine, double g)
{
    if (std::abs(g) < 1e-4)  // its derivative in g at 0
        return (cosine + 1) / 2 + 0.75 * g * (cosine * cosine - 1);
    return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * cosine) - 1 / (1 + g));
}

WarpCase phase(const char* name, float g)
{
    return {name, "vec4(sample_fog_phase(fog_of(p, q), vec3(0.36, -0.48, 0.8), u), 0.0)", {},
        glm::vec4(g), [=](const glm::dvec4& w) {
            const glm::dvec3 axis(0.36, -0.48, 0.8);
            const glm::dvec3 x = glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
            const glm::dvec3 way(w);
            const double below = phase_below(std::clamp(glm::dot(way, axis), -1.0, 1.0), g);
            return glm::dvec2(below, turn_of(glm::dot(way, x), glm::dot(way, cross(axis, x))));
        }};
}

double mean_over_channels(const glm::vec4& sigma_t, const std::function<double(double)>& of)
{
    return (of(sigma_t.x) + of(sigma_t.y) + of(sigma_t.z)) / 3;
}

WarpCase free_path(const char* name, const glm::vec4& sigma_t, double length)
{
    const auto below = [=](double way) {
        return mean_over_channels(sigma_t, [=](double sigma) { return -std::expm1(-sigma * way); });
    };
    return {name, "told(sample_fog(fog_of(p, q), q.y, u))", sigma_t,
        {0, static_cast<float>(length), 0, 0},
        [=](const glm::dvec4& event) -> std::optional<glm::dvec2> {
            if (event.y == 0)
                return std::nullopt;
            return glm::dvec2(below(event.x) / below(length), 0);
        },
        1 - below(length)};
}

WarpCase path_within(const char* name, const glm::vec4& sigma_t, double length)
{
    return {name, "told(sample_fog_within(fog_of(p, q), q.y, u))", sigma_t,
        {0, static_cast<float>(length), 0, 0}, [=](const glm::dvec4& event) {
            return glm::dvec2(mean_over_channels(sigma_t,
                                  [&](double sigma) {
                                      return sigma == 0 ? event.x / length
                                                        : std::expm1(-sigma * event.x)
                                              / std::expm1(-sigma * length);
                                  }),
                0);
        }};
}

std::vector<WarpCase> warp_cases()
{
    return {{"CosineHemisphere", "vec4(sample_cosine_hemisphere(u), 0.0)", {}, {},
                [](const glm::dvec4& w) {
                    return glm::dvec2(w.x * w.x + w.y * w.y, turn_of(w.x, w.y));
                }},
        {"Disk", "vec4(sample_disk(u), 0.0, 0.0)", {}, {},
            [](const glm::dvec4& w) {
                return glm::dvec2(w.x * w.x + w.y * w.y, turn_of(w.x, w.y));
            }},
        {"Triangle", "vec4(sample_triangle(u), 0.0, 0.0)", {}, {},
            [](const glm::dvec4& w) {
                const double far = w.x + w.y;
                return glm::dvec2(far * far, w.y / far);
            }},
        cone("Cone", 0.3F), cone("NarrowCone", 1e-6F), cone("AllDirections", 2),
        phase("Isotropic", 0), phase("AlmostIsotropic", 1e-5F), phase("Backward", -0.3F),
        phase("Forward", 0.8F), phase("FarBackward", -0.9F), phase("FarForward", 0.99F),
        free_path("GreyFreePath", glm::vec4(0.5F), 2),
        free_path("ColoredFreePath", {0.3F, 0, 4, 0}, 1.5),
        free_path("ThinFreePath", glm::vec4(1e-3F, 2e-3F, 5e-3F, 0), 100),
        path_within("GreyWithin", glm::vec4(0.5F), 2),
        path_within("ColoredWithin", {0.3F, 0, 4, 0}, 1.5),
        path_within("ThinWithin", glm::vec4(1e-6F, 1e-5F, 2e-5F, 0), 1),
        path_within("DenseWithin", glm::vec4(40, 1, 3, 0), 1)};
}

class WarpSampling : public GlTest, public testing::WithParamInterface<WarpCase> { };

TEST_P(WarpSampling, SamplesFollowTheirDensity)
{
    const WarpCase& c = GetParam();
    add_shader_file(
        "tests/warp_probe", read_text(FARLIGHT_SOURCE_DIR "/tests/shaders/warp_probe.comp"));
    const Program program(load_shader_source("tests/warp_probe", {{"WARP", c.warp}}));
    const glm::vec4 parameters[] = {c.p, c.q};
    Buffer probe("probe", std::as_bytes(std::span<const glm::vec4>(parameters)));
    const std::vector<glm::vec4> samples =
        run_compute(program, {{"probe", probe.texture(GL_RGBA32UI)}}, kWarpSamples, kWarpSamples);

    // A distance has no second coordinate: one column holds all.
    const bool flat = std::string_view(c.warp).starts_with("told");
    const std::size_t columns = flat ? 1 : kWarpColumns;
    const std::size_t bins = kWarpRows * columns;
    std::vector<double> expected(bins, kWarpSamples * (1 - c.rest) / static_cast<double>(bins));
    expected.push_back(kWarpSamples * c.rest);
    std::vector<double> found(bins + 1);
    for (const glm::vec4& sample : samples) {
        const auto at = c.uniform(glm::dvec4(sample));
        if (!at) {
            found[bins] += 1;
            continue;
        }
        ASSERT_GT(at->x, -1e-6);
        ASSERT_LT(at->x, 1 + 1e-6);
        const auto row = static_cast<std::size_t>(std::clamp(at->x, 0.0, 1.0) * kWarpRows);
        const auto column = static_cast<std::size_t>(at->y * static_cast<double>(columns));
        found[std::min(row, kWarpRows - 1) * columns + std::min(column, columns - 1)] += 1;
    }
    EXPECT_GT(
        chi_squared_p_value(expected, found), 1e-3 / static_cast<double>(warp_cases().size()));
}

INSTANTIATE_TEST_SUITE_P(Warps, WarpSampling, testing::ValuesIn(warp_cases()),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace farlight
