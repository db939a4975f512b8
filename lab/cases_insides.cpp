// What a path is inside of: which of several things fills a place, and more of them than it can
// keep.
#include "lab/compute.h"
#include "lab/groups.h"
#include "lab/lossless_materials.h"
#include "lab/rendering.h"
#include "lab/statistics.h"
#include "server/gl/buffer.h"
#include "server/scene/materials.h"

#include <cmath>

namespace farlight::lab {
namespace {

Material filling(float ior, float absorption, int priority)
{
    Material m = lossless::glass(0, ior);
    m.absorption = glm::vec3(absorption);
    m.priority = priority;
    return m;
}

/// A surface that a straight line meets.
struct Step {
    std::uint32_t material;
    bool front;  ///< Entered, else left.
    double eta;  ///< Of no meaning where nothing real is met.
    bool real;
    double absorption;  ///< Of what is behind.
};

/// A step a texel: eta, whether the surface is real, absorption behind it once crossed, overflows.
constexpr const char* kWalk = R"(#version 450
#include "bsdf/interior.glsl"
layout(local_size_x = 1) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer steps;
void main()
{
    Interior interior = outside_of_everything();
    for (int i = 0; i < textureSize(steps); ++i) {
        const uvec4 met = texelFetch(steps, i);
        const Inside inside = load_inside(met.x);
        ShadedMaterial m;
        m.ior = inside.ior;
        m.priority = inside.priority;
        m.transmission = 1.0;
        m.thin_walled = false;
        const Boundary boundary = boundary_at(interior, m, met.x, met.y != 0u);
        cross_boundary(interior, m, met.x, met.y != 0u);
        results[i] = vec4(boundary.eta, boundary.real ? 1.0 : 0.0, current_absorption(interior).x,
            float(interior.overflows));
    }
}
)";

/// Surfaces told wrongly, and how far an index is off.
void walk(double& wrong, double& off, const std::vector<Material>& materials,
    const std::vector<Step>& steps)
{
    std::vector<glm::uvec4> met;
    met.reserve(steps.size());
    for (const Step& step : steps)
        met.emplace_back(step.material, step.front ? 1 : 0, 0, 0);
    const std::vector<Image8> no_images;
    TextureLayout textures(no_images);
    textures.lay_out({});
    const farlight::Texels packed = pack_materials(materials, textures);
    Buffer material_buffer("materials", std::as_bytes(std::span<const glm::uvec4>(packed)));
    Buffer step_buffer("steps", std::as_bytes(std::span<const glm::uvec4>(met)));
    add_shader_file("lab/walk", kWalk);
    const Program program(load_shader_source("lab/walk", {{"FX_DIELECTRIC", "1"}}));
    const auto results = run_compute(program,
        {{"materials", material_buffer.texture(GL_RGBA32UI)},
            {"steps", step_buffer.texture(GL_RGBA32UI)}},
        steps.size(), 1);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const glm::vec4& r = results[i];
        wrong += r.y == (steps[i].real ? 1 : 0) ? 0 : 1;
        wrong += r.z == static_cast<float>(steps[i].absorption) && r.w == 0 ? 0 : 1;
        if (steps[i].real)
            off = farther(off, std::abs(static_cast<double>(r.x) - steps[i].eta));
    }
}

void ranks_of_insides(Findings& findings, Length /*length*/)
{
    constexpr std::uint32_t kWater = 0;
    constexpr std::uint32_t kIce = 1;
    constexpr std::uint32_t kGlass = 2;
    double wrong = 0;
    double off = 0;
    // Water reaches into the glass, ice into the water: the glass wins over both, the ice over
    // water.
    walk(wrong, off, {filling(1.33F, 1, 0), filling(1.31F, 2, 1), filling(1.5F, 3, 2)},
        {{kGlass, true, 1.5, true, 3}, {kWater, true, 0, false, 3},
            {kGlass, false, 1.33 / 1.5, true, 1}, {kIce, true, 1.31 / 1.33, true, 2},
            {kIce, false, 1.33 / 1.31, true, 1}, {kGlass, true, 1.5 / 1.33, true, 3},
            {kWater, false, 0, false, 3}, {kGlass, false, 1 / 1.5, true, 0}});
    // Of equals the one entered last counts, so plain nesting needs no priorities.
    walk(wrong, off, {filling(1.33F, 1, 0), filling(1.31F, 2, 0), filling(1.5F, 3, 0)},
        {{kGlass, true, 1.5, true, 3}, {kWater, true, 1.33 / 1.5, true, 1},
            {kIce, true, 1.31 / 1.33, true, 2}, {kWater, false, 0, false, 2},
            {kIce, false, 1.5 / 1.31, true, 3}, {kGlass, false, 1 / 1.5, true, 0}});
    // What was never entered can be left.
    walk(wrong, off, {filling(1.33F, 1, 0)},
        {{kWater, false, 1 / 1.33, true, 0}, {kWater, true, 1.33, true, 1}});
    findings.none("surfaces told wrongly, or what is behind them", wrong);
    findings.at_most("relative index off", off, 1e-6);
}

/// Balls in balls, of glass without loss, under a white sky.
Scene balls_in_balls(std::uint32_t count)
{
    Scene scene;
    scene.background = glm::vec3(1);
    for (std::uint32_t i = 0; i < count; ++i) {
        scene.materials.push_back(filling(1.2F + 0.15F * static_cast<float>(i), 0, 0));
        scene.objects.push_back({"ball", i, Sphere{{0, 0, 0}, 1 - 0.12 * i}});
    }
    scene.camera = {{0, 0, 3}, {0, 0, 0}, {0, 1, 0}, 45};
    return scene;
}

/// Whatever finds no place among what a path is inside of is counted, and no light is lost.
void more_insides_than_places(Findings& findings, Length /*length*/)
{
    for (const std::uint32_t count : {4U, 7U})
        for (const bool within : {false, true}) {
            Scene scene = balls_in_balls(count);
            if (within)
                scene.camera = {{0.05, 0, 0.1}, {0, 0, -3}, {0, 1, 0}, 60};
            const Drawn all = drawn(scene, averaged(16, true, 64));
            const std::string name =
                std::to_string(count) + " balls, seen from " + (within ? "within: " : "outside: ");
            findings.at_most(
                name + "mean off the sky's 1", std::abs(mean_of(all.image).mean - 1), 2e-3);
            const auto clamped = static_cast<double>(all.counted.of(BadKind::kClamped));
            findings.none(
                name + "values that are none", static_cast<double>(all.counted.all()) - clamped);
            if (count > 4 && !within)
                findings.at_least(name + "pixels counted", clamped, 100);
            if (count <= 4)
                findings.none(name + "pixels counted", clamped);
        }
}

constexpr Case kInsidesCases[] = {
    {"34c", "insides", "ranks of insides", Layer::kFunction,
        "Where transparent things overlap the highest priority fills the place, of equals the one "
        "entered last.",
        ranks_of_insides},
    {"34d", "insides", "more insides than places", Layer::kPicture,
        "Seven lossless balls in each other cannot be seen under a white sky; a path keeps four, "
        "and "
        "that is counted.",
        more_insides_than_places},
};

constexpr Guard kInsidesGuards[] = {
    {"entered_last_prevails", "34c", "bsdf/interior.glsl", "inside.priority >= best.priority",
        "inside.priority > best.priority"},
    {"crowded_paths_are_counted", "34d", "path_trace/path_trace.comp",
        "note(STAGE_HIT, crowded ? IS_CLAMPED : 0u);", ""},
};

}  // namespace

Group insides_group()
{
    return {kInsidesCases, kInsidesGuards};
}

}  // namespace farlight::lab
