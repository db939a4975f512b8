// Light transport in scenes whose light is known in closed form.
//
// Means of a sampled picture are bounded by 5 standard errors with fixed seeds: a fresh seed would
// pass them by chance once in 1.7 million.
#include "lab/groups.h"
#include "lab/meshes.h"
#include "lab/rendering.h"
#include "lab/statistics.h"

#include <algorithm>
#include <cmath>

namespace farlight::lab {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Inside a closed box that emits 1 and reflects rho a path of n segments sees 1 + rho + ... =
/// (1 - rho^n) / (1 - rho).
struct Furnace {
    float albedo;
    int max_depth;
};
constexpr Furnace kFurnaces[] = {{0.5F, 1}, {0.5F, 2}, {0.5F, 4}, {0.8F, 9}};

double radiance_in(const Furnace& f)
{
    return (1 - std::pow(static_cast<double>(f.albedo), f.max_depth))
        / (1 - static_cast<double>(f.albedo));
}

Scene furnace(float albedo)
{
    return box_of({"wall", glm::vec3(albedo), glm::vec3(1)});
}

void furnace_without_light_sampling(Findings& findings, Length /*length*/)
{
    double off = 0;
    for (const Furnace& f : kFurnaces) {
        Rendering how = averaged(1, false, f.max_depth);
        how.frames = 1;
        off = farther(off, largest_off(rendered(furnace(f.albedo), how), radiance_in(f)));
    }
    findings.at_most("radiance of any pixel off the series", off, 1e-5);
}

void furnace_with_light_sampling(Findings& findings, Length /*length*/)
{
    double off = 0;
    for (const Furnace& f : kFurnaces)
        off = farther(off,
            standard_errors_off(
                rendered(furnace(f.albedo), averaged(64, true, f.max_depth)), radiance_in(f)));
    findings.at_most("mean off the series [standard errors]", off, 5);
}

void roulette(Findings& findings, Length /*length*/)
{
    double off = 0;
    for (const Furnace& f : kFurnaces) {
        Rendering how = averaged(64, false, f.max_depth);
        how.settings.roulette_depth = 2;
        off = farther(off, standard_errors_off(rendered(furnace(f.albedo), how), radiance_in(f)));
    }
    findings.at_most("mean off the series [standard errors]", off, 5);
}

/// Paths in a dark box are ended almost always; those that go on weigh 1 / q, of which the least q
/// is 1 / 20.
void rare_survivors(Findings& findings, Length /*length*/)
{
    constexpr float kDark = 0.01F;
    Rendering how = averaged(1, false, 4);
    how.frames = 1;
    how.settings.roulette_depth = 1;
    const Image picture = rendered(furnace(kDark), how);
    double brightest = 0;
    for (const float value : values_of(picture))
        brightest = farther(brightest, value);
    // The first bounce is weighed apart; each of the next two brings 20 * albedo at most.
    const double most = static_cast<double>(kDark) * (1 + 0.2 + 0.04);
    findings.at_most("brightest pixel beyond what is always there", brightest - 1, 1.001 * most);
    findings.at_least("likewise, so that some path went on", brightest - 1, 0.95 * most);
}

Scene ball_under_a_white_sky(const Material& material)
{
    Scene scene;
    scene.materials.push_back(material);
    scene.objects.push_back({"ball", 0, Sphere{{0, 0, 0}, 1}});
    scene.background = glm::vec3(1);
    scene.camera.position = {0, 0, 3};
    scene.camera.target = {0, 0, 0};
    return scene;
}

void white_ball(Findings& findings, Length /*length*/)
{
    Rendering how = averaged(1, false, 4);
    how.frames = 1;
    findings.at_most("any pixel off the sky's 1",
        largest_off(rendered(ball_under_a_white_sky({"white", glm::vec3(1)}), how), 1), 1e-5);
}

void glass_ball(Findings& findings, Length /*length*/)
{
    Material glass{"glass", glm::vec3(1)};
    glass.specular = 1;
    glass.roughness = 0;
    glass.transmission = 1;
    Rendering how = averaged(16, true, 64);
    how.frames = 1;
    // What is left inside after 63 reflections is lost: less than 1e-6 of the light of any pixel
    // that is not total.
    findings.at_most("mean off the sky's 1",
        std::abs(mean_of(rendered(ball_under_a_white_sky(glass), how)).mean - 1), 1e-4);
}

/// Irradiance of a sphere of radius r and radiance L seen from distance d, straight above a floor:
/// pi (r / d)^2 L.
void tiny_bright_lamp(Findings& findings, Length /*length*/)
{
    constexpr double kRadius = 1e-4;
    constexpr double kRadiance = 1e8;
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)},
        {"lamp", glm::vec3(0), glm::vec3(static_cast<float>(kRadiance))}};
    scene.objects = {{"floor", 0, Quad{{-5, 0, -5}, {0, 0, 10}, {10, 0, 0}}},
        {"lamp", 1, Sphere{{0, 2, 0}, kRadius}}};
    scene.camera = {{0, 1, 1e-3}, {0, 0, 0}, {0, 1, 0}, 1};
    const double expected = 0.5 / kPi * kPi * (kRadius / 2) * (kRadius / 2) * kRadiance;
    const Image image = rendered(scene, averaged(1, true, 2));
    float brightest = 0;
    for (const float value : values_of(image))
        brightest = farther(brightest, value);
    // Within half a degree of straight below, cos^4 is 1 to 2e-4.
    findings.at_most(
        "relative error of the mean", std::abs(mean_of(image).mean / expected - 1), 5e-4);
    findings.at_most(
        "brightest pixel over the closed form", static_cast<double>(brightest) / expected, 10);
}

/// A lamp above a floor, and what is done to it.
Scene lamp_over_floor()
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F)}, {"lamp", glm::vec3(0), glm::vec3(5)}};
    scene.objects = {{"floor", 0, Quad{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}}},
        {"lamp", 1, Quad{{-0.5, 2, -0.5}, {1, 0, 0}, {0, 0, 1}}}};
    scene.camera = {{1.5, 1.2, 1.5}, {0, 0, 0}, {0, 1, 0}, 40};
    return scene;
}

void lamps_that_are_none(Findings& findings, Length /*length*/)
{
    const Scene scene = lamp_over_floor();
    Scene more = scene;
    more.materials.push_back({"dark lamp", glm::vec3(0), glm::vec3(0)});
    more.materials.push_back({"flat lamp", glm::vec3(0), glm::vec3(1e6F)});
    more.objects.push_back({"no power", 2, Quad{{-9, 9, -9}, {1, 0, 0}, {0, 0, 1}}});
    Mesh sliver{"sliver", {{9, 9, 9}, {10, 10, 10}, {11, 11, 11}}, {}, {{0, 1, 2}}};
    more.meshes.push_back(sliver);
    more.objects.push_back({"no area", 3, MeshInstance{}});
    // Off now, on later: it has a place among the lights.
    more.materials.push_back({"lamp that is off", glm::vec3(0), glm::vec3(1e6F)});
    more.objects.push_back({"off", 4, Quad{{-9, 9, -9}, {1, 0, 0}, {0, 0, 1}}});
    Track track;
    track.target = Track::Target::kMaterialEmission;
    track.index = 4;
    track.times = {0, 1};
    track.values = {0, 1};
    more.animation.tracks.push_back(track);
    const Rendering how = averaged(4, true, 4);
    const std::vector<float> without = values_of(rendered(scene, how));
    const std::vector<float> with = values_of(rendered(more, how));
    double unlike = 0;
    for (std::size_t i = 0; i < with.size(); ++i)
        unlike += with[i] == without[i] ? 0 : 1;
    findings.none("values that such lamps change", unlike);
}

void lamp_from_behind(Findings& findings, Length /*length*/)
{
    Scene scene = lamp_over_floor();
    std::get<Quad>(scene.objects[1].shape) = {{-0.5, 2, -0.5}, {0, 0, 1}, {1, 0, 0}};  // faces up
    const Image image = rendered(scene, averaged(16, true, 2));
    findings.none("light on a floor behind a one-sided lamp", largest_off(image, 0));
    // Edge-on: the lamp's plane holds the floor.
    std::get<Quad>(scene.objects[1].shape) = {{-0.5, 0, -4.5}, {1, 0, 0}, {0, 0, 1}};
    findings.none("light on a floor that lies in the lamp's plane",
        largest_off(rendered(scene, averaged(16, true, 2)), 0));
}

/// Absorption alone: what is seen through a depth d of fog is e^(-sigma d).
void fog_of_any_density(Findings& findings, Length /*length*/)
{
    Scene scene;
    scene.materials = {{"lamp", glm::vec3(0), glm::vec3(2)}};
    scene.objects = {{"lamp", 0, Quad{{-50, -50, -3}, {100, 0, 0}, {0, 100, 0}}}};
    scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.5};
    Rendering how = averaged(1, true, 2);
    how.frames = 1;
    const Image clear = rendered(scene, how);
    double off = 0;
    for (const float sigma : {1e-9F, 0.1F, 1.0F, 20.0F, 1e9F}) {
        scene.medium = {"fog", glm::vec3(sigma), glm::vec3(0), 0};
        off = farther(
            off, largest_off(rendered(scene, how), 2 * std::exp(-3 * static_cast<double>(sigma))));
    }
    findings.at_most("off 2 e^(-3 sigma), sigma 1e-9 to 1e9", off, 2e-5);
    scene.medium = {"none", glm::vec3(0), glm::vec3(0), 0};
    findings.none(
        "bytes that fog of no density changes", rendered(scene, how).bytes == clear.bytes ? 0 : 1);
}

constexpr Case kTransportCases[] = {
    {"26", "transport", "furnace by chance", Layer::kPicture,
        "In a closed box that emits and reflects, every pixel is the partial sum of the series.",
        furnace_without_light_sampling},
    {"26b", "transport", "furnace with light sampling", Layer::kPicture,
        "With lights sampled and weighted, the mean is the series too.",
        furnace_with_light_sampling},
    {"27", "transport", "white ball", Layer::kPicture,
        "A white ball under a white sky cannot be seen.", white_ball},
    {"33", "transport", "glass ball", Layer::kPicture,
        "A lossless glass ball under a white sky cannot be seen.", glass_ball},
    {"37", "transport", "lamp from behind", Layer::kPicture,
        "A one-sided lamp gives exactly nothing behind and in its plane.", lamp_from_behind},
    {"38", "transport", "lamps that are none", Layer::kPicture,
        "Lamps without power or area, or that are off, change no bit.", lamps_that_are_none},
    {"40", "transport", "tiny bright lamp", Layer::kPicture,
        "A lamp of radius 1e-4 and radiance 1e8 lights as the closed form says, without fireflies.",
        tiny_bright_lamp},
    {"41", "transport", "Russian roulette", Layer::kPicture,
        "Ending paths by chance leaves the mean as it is.", roulette},
    {"41b", "transport", "rare survivors", Layer::kPicture,
        "A path that goes on where most are ended weighs at most twenty.", rare_survivors},
    {"45", "transport", "fog of any density", Layer::kPicture,
        "Absorbing fog follows Beer and Lambert from 1e-9 to 1e9 a metre; none is none.",
        fog_of_any_density},
};

constexpr Guard kTransportGuards[] = {
    {"offset_leaves", "27 33", "geometry/surface.glsl",
        "position + geometric_normal * (dot(direction, geometric_normal) >= 0.0 ? offset : "
        "-offset);",
        "position;"},
    {"offset_on_the_side_left", "33", "geometry/surface.glsl",
        "(dot(direction, geometric_normal) >= 0.0 ? offset : -offset)", "offset"},
    {"longest_path", "26 26b", "path_trace/path_trace.comp", "bool alive = segment <= max_depth;",
        "bool alive = segment < max_depth;"},
    {"mis_weight", "26b", "path_trace/direct.glsl",
        "const float weight = light.delta ? 1.0 : power_heuristic(light.pdf, value.pdf);",
        "const float weight = 1.0;"},
    {"one_sided_lamps", "37", "lights/area.glsl",
        "light.emits_both_sides || dot(normal, way) < 0.0 ? light.radiance : vec3(0.0)",
        "light.radiance"},
    {"least_survival", "41b", "path_trace/path_trace.comp", "clamp(max_component(next), 0.05, 1.0)",
        "clamp(max_component(next), 1e-9, 1.0)"},
    {"roulette_weight", "41", "path_trace/path_trace.comp", "next /= survive;", ""},
    {"chosen_by_power", "38"},
    {"fog_ahead", "45", "media/fog.glsl", "clamp(middle - half_chord, 0.0, t_max)",
        "middle - half_chord"},
    {"cone_without_cancellation", "40", "lights/area.glsl",
        "return sin2 / (1.0 + sqrt(max(0.0, 1.0 - sin2)));",
        "return 1.0 - sqrt(max(0.0, 1.0 - sin2));"},
};

}  // namespace

Group transport_group()
{
    return {kTransportCases, kTransportGuards};
}

}  // namespace farlight::lab
