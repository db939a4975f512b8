// Insides: nested and overlapping transparent things, seen from outside and from within.
//
// Seeds are fixed. Means are bounded by 5 standard errors, which a fresh seed would pass once
// in 1.7 million; tests over tiles would fail by chance once in 100 (Sidak).
#include "lab/groups.h"
#include "lab/lossless_materials.h"
#include "lab/rendering.h"
#include "lab/statistics.h"
#include "server/scene/mesh_repair.h"

#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

namespace farlight::lab {
namespace {

constexpr double kWater = 1.33;
constexpr double kGlass = 1.5;
constexpr double kWaterAbsorption = 0.3;  // [1/m]
constexpr double kGlassAbsorption = 2;
constexpr double kInnerWall = 0.9;  // of the vessel, from its middle [m]
constexpr double kOuterWall = 1;

Material absorbing(double ior, double absorption, int priority)
{
    Material m = lossless::glass(0, static_cast<float>(ior));
    m.absorption = glm::vec3(static_cast<float>(absorption));
    m.priority = priority;
    return m;
}

void add_slab(Scene& scene, std::uint32_t material, double from, double to)
{
    const glm::dmat4 place = glm::translate(glm::dmat4(1), {0, 0, (from + to) / 2})
        * glm::scale(glm::dmat4(1), {80, 80, to - from});
    scene.objects.push_back({"slab", material, MeshInstance{0, place}});
}

/// Water between two panes, into which it reaches; a wall that shines behind it, nothing before.
Scene vessel()
{
    Scene scene;
    scene.materials = {absorbing(kGlass, kGlassAbsorption, 2),
        absorbing(kWater, kWaterAbsorption, 1), {"wall", glm::vec3(0), glm::vec3(1)}};
    scene.meshes.push_back(unit_cube());
    add_slab(scene, 0, kInnerWall, kOuterWall);
    add_slab(scene, 1, -0.95, 0.95);
    add_slab(scene, 0, -kOuterWall, -kInnerWall);
    scene.objects.push_back({"wall", 2, Quad{{-40, -40, -3}, {80, 0, 0}, {0, 80, 0}}});
    return scene;
}

/// A pile of layers with flat sides, without interference: what it passes, and what it reflects of
/// light from before and from behind.
struct Pile {
    double passes = 1;
    double before = 0;
    double behind = 0;

    void add_layer(double absorption, double way)
    {
        const double left = std::exp(-absorption * way);
        passes *= left;
        behind *= left * left;
    }
    /// The adding method: all reflections to and fro.
    void add_interface(double reflects)
    {
        const double through = 1 - reflects;
        const double rounds = 1 / (1 - behind * reflects);
        before += passes * passes * reflects * rounds;
        passes *= through * rounds;
        behind = reflects + through * through * behind * rounds;
    }
};

/// Fresnel's equations between media in which the sine times the index is `sine`.
double reflectance(double index_before, double index_behind, double sine)
{
    const double sine_before = sine / index_before;
    const double sine_behind = sine / index_behind;
    if (sine_behind >= 1)
        return 1;
    const double a = std::sqrt(1 - sine_before * sine_before);
    const double b = std::sqrt(1 - sine_behind * sine_behind);
    const double s = (index_before * a - index_behind * b) / (index_before * a + index_behind * b);
    const double p = (index_behind * a - index_before * b) / (index_behind * a + index_before * b);
    return 0.5 * (s * s + p * p);
}

double cosine_in(double index, double sine)
{
    return std::sqrt(std::max(1 - sine * sine / (index * index), 1e-12));
}

/// From the middle of the water out into the air.
Pile half_of_the_vessel(double sine)
{
    Pile pile;
    pile.add_layer(kWaterAbsorption, kInnerWall / cosine_in(kWater, sine));
    pile.add_interface(reflectance(kWater, kGlass, sine));
    pile.add_layer(kGlassAbsorption, (kOuterWall - kInnerWall) / cosine_in(kGlass, sine));
    pile.add_interface(reflectance(kGlass, 1, sine));
    return pile;
}

/// Of the wall, through all of it, along a unit way in the air.
double seen_from_outside(const glm::dvec3& way)
{
    const double sine = std::sqrt(1 - way.z * way.z);
    const double glass = (kOuterWall - kInnerWall) / cosine_in(kGlass, sine);
    Pile pile;
    pile.add_interface(reflectance(1, kGlass, sine));
    pile.add_layer(kGlassAbsorption, glass);
    pile.add_interface(reflectance(kGlass, kWater, sine));
    pile.add_layer(kWaterAbsorption, 2 * kInnerWall / cosine_in(kWater, sine));
    pile.add_interface(reflectance(kWater, kGlass, sine));
    pile.add_layer(kGlassAbsorption, glass);
    pile.add_interface(reflectance(kGlass, 1, sine));
    return pile.passes;
}

/// Along a unit way in the water from the middle: besides, what was reflected on the other side.
double seen_from_the_water(const glm::dvec3& way)
{
    const Pile half = half_of_the_vessel(kWater * std::sqrt(1 - way.z * way.z));
    return half.passes / (1 - half.before * half.before);
}

/// The picture that shows `radiance` along the way of each pixel.
Image expected(const CameraPose& camera, Extent extent,
    const std::function<double(const glm::dvec3&)>& radiance)
{
    const glm::dvec3 forward = glm::normalize(camera.target - camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double half = std::tan(glm::radians(camera.vertical_fov_degrees) / 2);
    std::vector<glm::vec3> pixels;
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            const double across = (2 * (x + 0.5) / extent.width - 1) * extent.width / extent.height;
            const double upwards = 1 - 2 * (y + 0.5) / extent.height;
            pixels.emplace_back(static_cast<float>(
                radiance(glm::normalize(forward + half * across * right + half * upwards * up))));
        }
    Image image;
    image.extent = extent;
    const auto bytes = std::as_bytes(std::span<const glm::vec3>(pixels));
    image.bytes.assign(bytes.begin(), bytes.end());
    return image;
}

void agree_with_layers(Findings& findings, const CameraPose& camera, Length length,
    const std::function<double(const glm::dvec3&)>& radiance)
{
    Scene scene = vessel();
    scene.camera = camera;
    Rendering how = averaged(length == Length::kLong ? 1024 : 64, true, 32);
    how.settings.antialiasing = false;
    how.extent = {32, 24};
    report_agreement(findings, "",
        agreement_of(expected(camera, how.extent, radiance), rendered(scene, how)), 5e-3);
}

void water_in_glass(Findings& findings, Length length)
{
    agree_with_layers(findings, {{0, 0, 2}, {0, -1, 1}, {0, 1, 0}, 50}, length, seen_from_outside);
}

void camera_in_the_water(Findings& findings, Length length)
{
    agree_with_layers(
        findings, {{0, 0, 0}, {0, -0.5, -1}, {0, 1, 0}, 50}, length, seen_from_the_water);
}

/// Fog that absorbs nothing, around a white ball under a white sky: there is nothing to be seen. In
/// grey fog every path brings back 1 unless it is cut off; with colours that is so in the mean.
void white_fog(Findings& findings, Length /*length*/)
{
    struct Fog {
        const char* name;
        glm::vec3 sigma_s;
        float g;
        bool grey;
    };
    // Optical thickness across the fog is up to 8 sigma: thin enough that 64 segments get out.
    static constexpr Fog kFogs[] = {{"isotropic", glm::vec3(0.2F), 0, true},
        {"next to none", glm::vec3(1e-7F), 0, true}, {"forward", glm::vec3(0.4F), 0.8F, true},
        {"all forward", glm::vec3(0.4F), 0.999F, true}, {"backward", glm::vec3(0.2F), -0.5F, true},
        {"coloured", {0.05F, 0.2F, 0.4F}, 0.3F, false},
        {"one channel clear", {0.2F, 0, 0.1F}, 0, false}};
    Scene scene;
    scene.materials.push_back({"white", glm::vec3(1)});
    scene.objects.push_back({"ball", 0, Sphere{{0, 0, 0}, 1}});
    scene.background = glm::vec3(1);
    scene.camera = {{0, 1, 3.2}, {0, 0, 0}, {0, 1, 0}, 45};
    for (const Fog& fog : kFogs) {
        scene.medium = {"fog", glm::vec3(0), fog.sigma_s, fog.g};
        Rendering how = averaged(fog.grey ? 8 : 128, true, 64);
        how.settings.antialiasing = false;
        how.extent = {32, 24};
        how.frames = 1;
        const Image image = rendered(scene, how);
        const std::string name = std::string(fog.name) + " fog: ";
        // Weights of up to 64 vertices, each off by an ulp or two, and as many steps.
        if (fog.grey)
            findings.at_most(name + "any pixel off the sky's 1", largest_off(image, 1), 1e-4);
        else
            findings.at_most(
                name + "mean off the sky's 1 [standard errors]", standard_errors_off(image, 1), 5);
    }
}

constexpr Case kMediaCases[] = {
    {"34", "media", "water in glass", Layer::kPicture,
        "Water that reaches into the panes around it passes what its layers do in closed form.",
        water_in_glass},
    {"34b", "media", "camera in the water", Layer::kPicture,
        "Likewise for who looks out of the water.", camera_in_the_water},
    {"45b", "media", "white fog", Layer::kPicture,
        "A white ball in fog that absorbs nothing cannot be seen under a white sky.", white_fog},
};

constexpr Guard kMediaGuards[] = {
    {"fog_s_share", "45b", "path_trace/path_trace.comp",
        "scattered += event.weight * (g.direct + g.indirect);",
        "scattered += g.direct + g.indirect;"},
    {"highest_priority_prevails", "34 34b", "bsdf/interior.glsl",
        "if (entered[k] != 0u && inside.priority >= best.priority)", "if (entered[k] != 0u)"},
    {"paths_start_in_what_is_around", "34b"},
    {"camera_s_medium_absorbs", "34b", "gbuffer/first_surface.glsl",
        "return exp(-frame.camera_absorption * way);", "return vec3(1.0);"},
};

}  // namespace

Group media_group()
{
    return {kMediaCases, kMediaGuards};
}

}  // namespace farlight::lab
