// Ways to find the same light: they agree, whichever is taken and however many lights there are.
//
// Seeds are fixed. Means are bounded by 5 standard errors, which a fresh seed would pass once
// in 1.7 million; tests over tiles and chi-squared would fail by chance once in 100 (Sidak).
#include "lab/compute.h"
#include "lab/groups.h"
#include "lab/rendering.h"
#include "lab/statistics.h"

#include <cmath>
#include <numbers>
#include <random>

namespace farlight::lab {
namespace {

/// A floor that a lamp stands on: light of density 1 / distance^2 in the corner.
Scene lamp_on_the_floor()
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)}, {"lamp", glm::vec3(0), glm::vec3(1)}};
    scene.objects = {{"floor", 0, Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}},
        {"lamp", 1, Quad{{-0.5, 0, 0}, {1, 0, 0}, {0, 0.5, 0}}}};
    // Above the lamp's edge, so that it is not seen.
    scene.camera = {{0, 2, 0}, {0, 0, 0}, {0, 0, -1}, 20};
    return scene;
}

/// With weights w = p^2 / (p^2 + q^2) the sample of the light is at most rho L / 2, that of the
/// surface rho L, whatever the distance.
void brightest_sample(Findings& findings, Length length)
{
    const DeviceScene scene(lamp_on_the_floor());
    Rendering how = averaged(1, true, 2);
    how.frames = 1;
    double most = 0;
    const unsigned frames = length == Length::kLong ? 256 : 16;
    for (how.settings.seed = 1; how.settings.seed <= frames; ++how.settings.seed)
        for (const float value : values_of(rendered(scene, how)))
            most = farther(most, static_cast<double>(value));
    findings.at_most(
        "brightest sample over the most that there can be", most / (1.5 * 0.5), 1 + 1e-5);
}

/// Lamps of every kind but those without extent, seen by paint, rough metal, a mirror and glass.
Scene lamps_over_everything()
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)}, {"lamp", glm::vec3(0), glm::vec3(3)},
        {.name = "rough", .albedo = glm::vec3(0.9F), .metallic = 1, .roughness = 0.5F},
        {.name = "mirror", .albedo = glm::vec3(0.9F), .metallic = 1, .roughness = 0},
        {.name = "glass",
            .albedo = glm::vec3(1),
            .roughness = 0,
            .specular = 1,
            .transmission = 1}};
    scene.objects = {{"floor", 0, Quad{{-2, 0, -2}, {0, 0, 4}, {4, 0, 0}}},
        {"quad", 1, Quad{{-1.5, 1.5, -1}, {1, 0, 0}, {0, 0, 1}}},
        {"disk", 1, Disk{{1, 1.5, 0}, {0, -1, 0}, 0.5}}, {"ball", 1, Sphere{{0, 1.2, -1}, 0.3}},
        {"rough", 2, Quad{{-2, 0, -1.5}, {2, 0, 0}, {0, 1.5, -0.5}}},
        {"mirror", 3, Quad{{0, 0, -1.5}, {2, 0, 0}, {0, 1.5, -0.5}}},
        {"glass", 4, Sphere{{0.4, 0.3, 0.4}, 0.25}}};
    scene.background = glm::vec3(0.1F);
    scene.camera = {{0, 1, 3}, {0, 0.4, 0}, {0, 1, 0}, 50};
    return scene;
}

enum class Estimator : std::uint8_t { kChance, kLights, kBoth };

Image estimated(const Scene& scene, Estimator estimator, int samples)
{
    Rendering how = averaged(samples, estimator != Estimator::kChance, 4);
    how.settings.seed = 7 + static_cast<std::uint32_t>(estimator);
    if (estimator != Estimator::kLights)
        return rendered(scene, how);
    const ChangedShader sampled("path_trace/direct.glsl",
        "vec3 arriving = light.radiance * (weight / light.pdf);",
        "vec3 arriving = light.radiance / light.pdf;");
    const ChangedShader lamps_by_chance("path_trace/direct.glsl",
        "return m.emission * chance_weight(bounce, pdf_light);",
        "return bounce.delta ? m.emission : vec3(0.0);");
    const ChangedShader sky_by_chance("path_trace/direct.glsl",
        "return radiance * chance_weight(bounce, pdf_light);",
        "return bounce.delta ? radiance : vec3(0.0);");
    return rendered(scene, how);
}

void three_estimators(Findings& findings, Length length)
{
    const Scene scene = lamps_over_everything();
    const int samples = length == Length::kLong ? 512 : 12;
    const Image chance = estimated(scene, Estimator::kChance, samples);
    const Image lights = estimated(scene, Estimator::kLights, samples);
    const Image both = estimated(scene, Estimator::kBoth, samples);
    report_agreement(findings, "chance and both: ", agreement_of(chance, both), 0.005);
    report_agreement(findings, "lights and both: ", agreement_of(lights, both), 0.005);
    report_agreement(findings, "chance and lights: ", agreement_of(chance, lights), 0.007);
}

/// Chance finds no lamp without extent: what is left is to sample them.
void lamps_without_extent(Findings& findings, Length length)
{
    Scene scene = lamps_over_everything();
    scene.lights = {{.name = "point", .intensity = glm::vec3(2), .position = {-0.5, 1, 0.5}},
        {.name = "sun",
            .kind = PunctualLight::Kind::kDirectional,
            .direction = glm::normalize(glm::dvec3(0.3, -1, -0.2))}};
    const int samples = length == Length::kLong ? 512 : 12;
    report_agreement(findings, "lights and both: ",
        agreement_of(estimated(scene, Estimator::kLights, samples),
            estimated(scene, Estimator::kBoth, samples)),
        0.005);
}

/// `count` dim triangles over a floor, and a bright one that sends as much light as all of them.
Scene bright_among_dim(std::size_t count)
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)}, {"dim", glm::vec3(0), glm::vec3(1)},
        {"bright", glm::vec3(0), glm::vec3(static_cast<float>(count))}};
    scene.objects.push_back({"floor", 0, Quad{{-5, 0, -5}, {0, 0, 10}, {10, 0, 0}}});
    std::mt19937 random(39);
    std::uniform_real_distribution<float> uniform(-2, 2);
    Mesh dim{"dim", {}, {}, {}};
    const auto add = [&](Mesh& mesh, const glm::vec3& at) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(
            mesh.positions.end(), {at, at + glm::vec3(0.01F, 0, 0), at + glm::vec3(0, 0, 0.01F)});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    };
    for (std::size_t i = 0; i < count; ++i)
        add(dim, {uniform(random), 1.5F, uniform(random)});
    Mesh bright{"bright", {}, {}, {}};
    add(bright, {0.3F, 1, 0.2F});
    scene.meshes = {dim, bright};
    scene.objects.push_back({"dim", 1, MeshInstance{0}});
    scene.objects.push_back({"bright", 2, MeshInstance{1}});
    scene.camera = {{0, 0.5, 0.2}, {0, 0, 0}, {0, 1, 0}, 0.5};
    return scene;
}

/// What choose_light() does at points of the floor, 8 of them: kPmf a texel a light, else a texel a
/// draw.
enum class Choice : std::uint8_t { kPmf, kDraw };
constexpr std::size_t kPlaces = 8;

std::vector<glm::vec4> choices(const DeviceScene& scene, Choice choice, std::size_t each)
{
    add_shader_file("lab/choices", R"(#version 450
#include "lib/random.glsl"
#include "lights/lights.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    const uint place = i / EACH, k = i % EACH;
    const vec4 u = random4(uvec2(place, 5u), 3u, 0u, 0u, 0u);
    const vec3 position = vec3(4.0 * u.x - 2.0, 0.0, 4.0 * u.y - 2.0);
    const vec3 normal = vec3(0.0, 1.0, 0.0);
#ifdef DRAW
    float pmf;
    const uint light = choose_light(position, normal, random4(uvec2(i, k), 1u, 0u, 0u, 0u), pmf);
    if (i < EACH * PLACES)
        results[i] = vec4(uintBitsToFloat(light | 0x3f000000u), pmf, light_pmf(load_light(light), position, normal), 0.0);
#else
    if (i < EACH * PLACES)
        results[i] = vec4(light_pmf(load_light(k), position, normal));
#endif
}
)");
    Defines defines = scene.inputs.defines;
    defines.emplace_back("EACH", std::to_string(each) + "u");
    defines.emplace_back("PLACES", std::to_string(kPlaces) + "u");
    if (choice == Choice::kDraw)
        defines.emplace_back("DRAW", "1");
    const Program program(load_shader_source("lab/choices", defines));
    return run_compute(program, scene.inputs.buffers, each * kPlaces, each * kPlaces);
}

void one_bright_lamp_of_many(Findings& findings, Length length)
{
    const DeviceScene scene(bright_among_dim(length == Length::kLong ? 100'000 : 10'000));
    const std::size_t lights = scene.shared.light_count;
    const std::size_t draws = 1U << 16U;
    const std::vector<glm::vec4> pmfs = choices(scene, Choice::kPmf, lights);
    const std::vector<glm::vec4> drawn = choices(scene, Choice::kDraw, draws);
    double sum_off = 0;
    double told_off = 0;
    double least = 1;
    for (std::size_t place = 0; place < kPlaces; ++place) {
        std::vector<double> expected(lights);
        std::vector<double> found(lights);
        double sum = 0;
        for (std::size_t i = 0; i < lights; ++i) {
            const auto pmf = static_cast<double>(pmfs[place * lights + i].x);
            sum += pmf;
            expected[i] = pmf * static_cast<double>(draws);
        }
        for (std::size_t k = 0; k < draws; ++k) {
            const glm::vec4& draw = drawn[place * draws + k];
            found.at(glm::floatBitsToUint(draw.x) & 0xffffffU) += 1;
            told_off = farther(told_off, std::abs(static_cast<double>(draw.y / draw.z) - 1));
        }
        sum_off = farther(sum_off, std::abs(sum - 1));
        const double p = chi_squared_p_value(expected, found);
        least = p >= least ? least : p;
    }
    findings.at_most("sum of probabilities off 1", sum_off, 1e-6);
    findings.at_most("probability told with the choice off that asked for", told_off, 1e-5);
    findings.at_least("least p-value of chi-squared", least,
        1 - std::pow(0.99, 1.0 / static_cast<double>(kPlaces)));
}

/// Lambert 1760: E = 1/2 |sum theta_i (n . Gamma_i)| of a polygon above the horizon, seen from the
/// origin.
double irradiance_of(const std::vector<glm::dvec3>& corners)
{
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3& a = corners[i];
        const glm::dvec3& b = corners[(i + 1) % corners.size()];
        const glm::dvec3 across = glm::cross(a, b);
        sum += std::atan2(glm::length(across), glm::dot(a, b)) * glm::normalize(across);
    }
    return 0.5 * std::abs(sum.y);
}

void light_of_one_bright_lamp(Findings& findings, Length length)
{
    const Scene scene = bright_among_dim(length == Length::kLong ? 100'000 : 10'000);
    double expected = 0;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        for (const glm::uvec3& t : scene.meshes[m].triangles) {
            const std::vector<glm::vec3>& p = scene.meshes[m].positions;
            expected += static_cast<double>(scene.materials[m + 1].emission.x)
                * irradiance_of({p[t.x], p[t.y], p[t.z]});
        }
    expected *= 0.5 / std::numbers::pi;
    const Image image = rendered(scene, averaged(16, true, 2));
    const Estimate mean = mean_of(image);
    // 2e-4: light changes by as much over the piece of floor that is seen.
    findings.at_most("mean off Lambert's formula [standard errors]",
        std::abs(mean.mean - expected) / (mean.standard_error + 2e-4 * expected), 5);
    findings.at_most("standard error over the mean", mean.standard_error / mean.mean, 5e-3);
}

constexpr Case kEstimatorsCases[] = {
    {"30b", "estimators", "a lamp that stands on the floor", Layer::kPicture,
        "No sample of a floor is brighter than 3/2 of what a lamp all around would make it, "
        "however "
        "near the lamp.",
        brightest_sample},
    {"35", "estimators", "three estimators", Layer::kPicture,
        "Light by chance, by sampling lamps and by both is the same, in mirrors and behind glass "
        "too.",
        three_estimators},
    {"35b", "estimators", "lamps without extent", Layer::kPicture,
        "A lamp that chance cannot find is not weighed against chance.", lamps_without_extent},
    {"39", "estimators", "one bright lamp of many", Layer::kFunction,
        "One triangle as strong as ten thousand others is chosen as often as told; probabilities "
        "sum "
        "to 1.",
        one_bright_lamp_of_many},
    {"39b", "estimators", "light of one bright lamp of many", Layer::kPicture,
        "A floor under them is as bright as Lambert's formula says.", light_of_one_bright_lamp},
};

constexpr Guard kEstimatorsGuards[] = {
    {"weighed_by_both_densities", "30b", "path_trace/direct.glsl",
        "1.0 : power_heuristic(light.pdf, value.pdf);", "1.0 : 1.0;"},
    {"mirrors_are_not_weighed", "35", "path_trace/direct.glsl",
        "return bounce.delta ? 1.0 : power_heuristic",
        "return bounce.delta ? 0.0 : power_heuristic"},
    {"points_are_not_weighed", "35b", "path_trace/direct.glsl",
        "= light.delta ? 1.0 : power_heuristic", "= light.delta ? 0.5 : power_heuristic"},
    {"shares_add_up", "39", "lights/light_tree.glsl",
        "        pmf *= to_first ? share : importance_second > 0.0 ? 1.0 - share : 0.0;\n"
        "        node = to_first ? node + 1u : link;\n"
        "        link = to_first ? first.link : second.link;\n        ++level;",
        "        pmf *= to_first ? share : 1.0;\n"
        "        node = to_first ? node + 1u : link;\n"
        "        link = to_first ? first.link : second.link;\n        ++level;"},
    {"fresh_number_a_level", "39", "lights/light_tree.glsl", "floatBitsToUint(u.y), level)).x;",
        "floatBitsToUint(u.y), 0u)).x;"},
    {"chance_of_the_light", "39b", "lights/lights.glsl", "s.pdf = pmf > 0.0 ? s.pdf * pmf : 0.0;",
        "s.pdf = pmf > 0.0 ? s.pdf : 0.0;"},
};

}  // namespace

Group estimators_group()
{
    return {kEstimatorsCases, kEstimatorsGuards};
}

}  // namespace farlight::lab
