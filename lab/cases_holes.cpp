// Surfaces with holes, by the thousand.
//
// Seeds are fixed. Means are bounded by 5 standard errors, which a fresh seed would pass once
// in 1.7 million.
#include "lab/groups.h"
#include "lab/rendering.h"
#include "lab/statistics.h"

#include <cmath>

namespace farlight::lab {
namespace {

/// A coloured floor and a ball under a lamp, seen through what is to hang before the camera.
Scene things()
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.5F, 0.4F, 0.3F)},
        {"ball", glm::vec3(0.2F, 0.6F, 0.4F)}, {"lamp", glm::vec3(0), glm::vec3(4)}};
    scene.objects = {{"floor", 0, Quad{{-3, -1, -3}, {0, 0, 6}, {6, 0, 0}}},
        {"ball", 1, Sphere{{0, -0.5, 0}, 0.5}},
        {"lamp", 2, Quad{{-0.5, 2, -0.5}, {1, 0, 0}, {0, 0, 1}}}};
    scene.background = glm::vec3(0.1F);
    scene.camera = {{0, 0.3, 3}, {0, -0.4, 0}, {0, 1, 0}, 40};
    return scene;
}

/// Layers of hole before the camera, between 1 and 2 m from it: masks whose texel there is clear,
/// or blends of no opacity.
void hang(Scene& scene, int layers, AlphaMode mode)
{
    const auto material = static_cast<std::uint32_t>(scene.materials.size());
    Material open{"open", glm::vec3(1)};
    open.alpha_mode = mode;
    open.albedo_texture.image = static_cast<std::uint32_t>(scene.images.size());
    open.albedo_texture.nearest = true;
    // Everywhere the middle of the texel that is clear.
    open.albedo_texture.image_from_uv = {glm::vec3(0), glm::vec3(0), glm::vec3(0.25, 0.5, 1)};
    scene.images.push_back({"hole", 2, 1, {{255, 255, 255, 0}, {255, 255, 255, 255}}});
    scene.materials.push_back(open);
    for (int i = 0; i < layers; ++i)
        scene.objects.push_back(
            {"hole", material, Quad{{-3, -3, 2 - (i + 0.5) / layers}, {6, 0, 0}, {0, 6, 0}}});
}

Rendering through_holes()
{
    Rendering how = averaged(1, true, 4);
    how.extent = {16, 12};
    how.frames = 1;
    return how;
}

/// Whose texture says so all over: they are not drawn.
void things_that_are_all_hole(Findings& findings, Length /*length*/)
{
    const Rendering how = through_holes();
    const Image without = rendered(things(), how);
    for (const AlphaMode mode : {AlphaMode::kMask, AlphaMode::kBlend}) {
        Scene scene = things();
        hang(scene, 10'000, mode);
        scene.images.back().texels.assign(2, {255, 255, 255, 0});
        findings.none(std::string("values that ten thousand ")
                + (mode == AlphaMode::kMask ? "open masks" : "blends of nothing") + " change",
            values_unlike(rendered(scene, how), without));
    }
}

double pixels_unlike(const Image& a, const Image& b)
{
    double unlike = 0;
    for (int y = 0; y < a.extent.height; ++y)
        for (int x = 0; x < a.extent.width; ++x)
            unlike += pixel(a, x, y) == pixel(b, x, y) ? 0 : 1;
    return unlike;
}

/// Whose texture has something elsewhere: every ray has to look. Where that takes more rounds of
/// loops than the device goes through, the pixel is not known, and is counted.
void many_holes(Findings& findings, Length length)
{
    const Rendering how = through_holes();
    const Image without = rendered(things(), how);
    for (const AlphaMode mode : {AlphaMode::kMask, AlphaMode::kBlend})
        for (const int layers : {100, length == Length::kLong ? 100'000 : 10'000}) {
            Scene scene = things();
            hang(scene, layers, mode);
            const Drawn through = drawn(scene, how);
            const auto cut = static_cast<double>(through.counted.of(BadKind::kClamped));
            const std::string name = std::to_string(layers)
                + (mode == AlphaMode::kMask ? " open masks: " : " blends of nothing: ");
            findings.none(name + "pixels changed beyond those counted",
                std::max(pixels_unlike(through.image, without) - cut, 0.0));
            findings.none(
                name + "values that are none", static_cast<double>(through.counted.all()) - cut);
            if (layers == 100)
                findings.none(name + "pixels counted", cut);
        }
}

/// What shows through half of it: half of either, through two the quarter of what is behind.
void half_there(Findings& findings, Length length)
{
    for (const int layers : {1, 2, 6}) {
        Scene scene;
        scene.materials = {{"veil", glm::vec3(0), glm::vec3(1, 0, 0), true}};
        scene.materials[0].alpha_mode = AlphaMode::kBlend;
        scene.materials[0].opacity = 0.5F;
        for (int i = 0; i < layers; ++i)
            scene.objects.push_back({"veil", 0, Quad{{-3, -3, -0.1 * i}, {6, 0, 0}, {0, 6, 0}}});
        scene.background = glm::vec3(0, 0, 1);
        scene.camera = {{0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 40};
        Rendering how = averaged(1, true, 2);
        how.frames = length == Length::kLong ? 1024 : 64;
        const Image image = rendered(scene, how);
        const double passes = std::ldexp(1, -layers);
        const double error =
            std::sqrt(passes * (1 - passes) / (how.extent.width * how.extent.height * how.frames));
        glm::dvec3 mean(0);
        for (int y = 0; y < how.extent.height; ++y)
            for (int x = 0; x < how.extent.width; ++x)
                mean += glm::dvec3(pixel(image, x, y));
        mean /= how.extent.width * how.extent.height;
        const std::string name = std::to_string(layers) + " layers: ";
        findings.at_most(name + "mean off the mix [standard errors]",
            std::max(std::abs(mean.x - (1 - passes)), std::abs(mean.z - passes)) / error, 5);
        findings.at_most(
            name + "light that is neither", std::abs(mean.x + mean.z - 1) + mean.y, 1e-5);
    }
}

constexpr Case kHolesCases[] = {
    {"46", "holes", "things that are all hole", Layer::kPicture,
        "Ten thousand layers that are nothing but hole change no bit.", things_that_are_all_hole},
    {"46b", "holes", "half there", Layer::kPicture,
        "What is half there shows half of itself and half of what is behind.", half_there},
    {"46c", "holes", "ten thousand holes", Layer::kPicture,
        "Ten thousand layers with a hole change no pixel, or it is counted that the device gave "
        "up.",
        many_holes},
};

constexpr Guard kHolesGuards[] = {
    {"holes_are_not_drawn", "46"},
    {"loops_that_ran_out", "46c", "lib/loops.glsl", "return rounds < 4;", "return false;"},
    {"a_number_a_layer", "46b", "geometry/coverage.glsl",
        "const uvec4 primitive = uvec4(hit.slot, instance, passed > 0.0 ? 1u : 0u, 0u);",
        "const uvec4 primitive = uvec4(0u);"},
};

}  // namespace

Group holes_group()
{
    return {kHolesCases, kHolesGuards};
}

}  // namespace farlight::lab
