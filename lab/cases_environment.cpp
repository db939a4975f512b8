// Light from all around: maps where their coordinates are at an end or say nothing.
//
// Seeds are fixed. Means are bounded by 5 standard errors, which a fresh seed would pass once
// in 1.7 million; tests over tiles and chi-squared would fail by chance once in 100 (Sidak).
#include "lab/compute.h"
#include "lab/environment_oracle.h"
#include "lab/evaluate.h"
#include "lab/groups.h"
#include "lab/rendering.h"
#include "lab/statistics.h"
#include "server/gl/buffer.h"
#include "server/scene/environment.h"
#include "shaders/shared/frame_constants.h"

#include <cmath>
#include <memory>

namespace farlight::lab {
namespace {

/// `body` for each row of `rows`, by the functions that the path tracer uses of a map.
std::vector<glm::vec4> on_device(const EnvironmentMap& map, const std::string& body,
    const std::vector<glm::vec4>& rows, std::size_t results)
{
    const PackedEnvironment packed = pack_environment(map, glm::mat3(1));
    add_shader_file("lab/environment", R"(#version 450
#define FX_BACKGROUND 1
#define FX_LIGHTS 1
#define FX_ENVIRONMENT_MAP 1
#include "lights/environment.glsl"
#include "lib/random.glsl"
layout(local_size_x = 64) in;
layout(std430) buffer output_block { vec4 results[]; };
uniform usamplerBuffer rows;
vec4 at_place(vec3 way)
{
    const ivec2 size = environment_size();
    const vec2 place = environment_place(way);
    const ivec2 texel = clamp(ivec2(place * vec2(size)), ivec2(0), size - 1);
    return vec4(map_radiance(size, place).x, place, environment_texel(size, texel).w);
}
void main()
{
    const uint i = gl_GlobalInvocationID.x;
    const vec4 x = uintBitsToFloat(texelFetch(rows, int(i) % textureSize(rows)));
)" + body + "}\n");
    const Program program(load_shader_source("lab/environment"));
    shared::FrameConstants frame{};
    frame.background = {1, 1, 1};
    const Buffer block(
        "frame", std::as_bytes(std::span<const shared::FrameConstants, 1>(&frame, 1)));
    if (const auto found = program.uniform_blocks().find("frame_block");
        found != program.uniform_blocks().end())
        glBindBufferBase(GL_UNIFORM_BUFFER, found->second, block.id());
    Buffer environment("environment", std::as_bytes(std::span<const glm::uvec4>(packed.texels)));
    Buffer row_buffer("rows", std::as_bytes(std::span<const glm::vec4>(rows)));
    return run_compute(program,
        {{"environment", environment.texture(GL_RGBA32UI)},
            {"rows", row_buffer.texture(GL_RGBA32UI)}},
        results, results);
}

void ends_of_coordinates(Findings& findings, Length /*length*/)
{
    const std::vector<glm::vec4> ways = ways_to_ends();
    double outside = 0;
    double off = 0;
    for (const auto& [width, height] : {std::pair{64U, 32U}, {5U, 3U}, {2U, 1U}, {1U, 1U}}) {
        const auto map = random_map(width, height);
        const std::vector<glm::vec4> found =
            on_device(*map, "    results[i] = at_place(x.xyz);\n", ways, ways.size());
        for (std::size_t i = 0; i < ways.size(); ++i) {
            const glm::vec4& f = found[i];
            outside += f.y >= 0 && f.y <= 1 && f.z >= 0 && f.z <= 1 && f.w >= 0 ? 0 : 1;
            // So near a pole its squares vanish, a way has no longitude: any of the row will do.
            const glm::dvec3 way(ways[i]);
            double nearest = std::abs(static_cast<double>(f.x) - radiance_along(*map, way));
            if (std::hypot(way.x, way.z) < 1e-18)
                for (std::uint32_t k = 0; k < 2 * width; ++k)
                    nearest = std::min(nearest,
                        std::abs(static_cast<double>(f.x)
                            - radiance_at(*map, 0.5 * k / width, way.y > 0 ? 0 : 1)));
            off = farther(off, nearest);
        }
    }
    findings.none("places outside the map", outside);
    // 64 texels of the circle, two of its roundings and the arc tangent's.
    findings.at_most("radiance off bilinear interpolation in double precision", off, 1e-4);
}

struct HotMap {
    const char* name;
    std::shared_ptr<EnvironmentMap> map;
};

std::vector<HotMap> hot_maps()
{
    std::vector<HotMap> maps;
    const auto add = [&](const char* name, std::uint32_t width, std::uint32_t height,
                         std::size_t hot) {
        auto map = map_of(width, height, [](const glm::dvec3&) { return 1e-3; });
        map->texels[hot] = glm::vec3(1e6F);
        maps.push_back({name, map});
    };
    add("hot at the pole", 9, 5, 4);
    add("hot at the other pole", 9, 5, 40);
    add("hot at the seam", 8, 4, 15);
    add("of one texel", 1, 1, 0);
    add("of one row", 3, 1, 1);
    maps.push_back({"random", random_map(16, 8)});
    return maps;
}

void samples_of_hot_maps(Findings& findings, Length length)
{
    const std::size_t count = length == Length::kLong ? 1U << 20U : 1U << 15U;
    double broken = 0;
    double off = 0;
    double agreeing = 1;
    for (const HotMap& hot : hot_maps()) {
        const std::vector<glm::vec4> drawn = on_device(*hot.map, R"(
    const LightSample s = sample_environment(random4(uvec2(i, 0u), 1u, 0u, 0u, SLOT_LIGHT).xyz);
    const vec4 there = at_place(s.wi);
    results[i] = vec4(s.radiance.x, s.pdf, there.w, abs(length(s.wi) - 1.0));
)",
            {glm::vec4(0)}, count);
        double sum = 0;
        double squares = 0;
        double same = 0;
        for (const glm::vec4& d : drawn) {
            const double weight = static_cast<double>(d.x) / static_cast<double>(d.y);
            broken += std::isfinite(weight) && d.w <= 1e-5F ? 0 : 1;
            same += std::abs(d.y - d.z) <= 1e-4F * d.y ? 1 : 0;
            sum += weight;
            squares += weight * weight;
        }
        const auto n = static_cast<double>(count);
        const double mean = sum / n;
        const double error = std::sqrt(std::max(squares / n - mean * mean, 0.0) / n);
        const double expected = integral_of(*hot.map);
        off = farther(off, std::abs(mean - expected) / (error + 1e-3 * expected));
        agreeing = std::min(agreeing, same / n);
    }
    findings.none("weights that are not finite, ways that are not unit", broken);
    findings.at_most("light of all directions off its integral [standard errors]", off, 5);
    // At a texel's edge rounding decides which of two a way is in.
    findings.at_most("share of samples whose density is not that of their way", 1 - agreeing, 1e-3);
}

/// A small plane of albedo 0.5 under a sky 1 + b . w, |b| = 0.8, `angle` from the normal.
Scene plane_under_linear_sky(double angle)
{
    Scene scene;
    scene.materials = {{"plane", glm::vec3(0.5F)}};
    scene.objects.push_back({"plane", 0, Quad{{-1e-3, 0, -1e-3}, {0, 0, 2e-3}, {2e-3, 0, 0}}});
    scene.camera = {{0.02, 0.02, -0.02}, {0, 0, 0}, {0, 1, 0}, 0.5};
    const glm::dvec3 b = 0.8 * glm::dvec3(std::sin(angle), std::cos(angle), 0);
    scene.environment =
        map_of(256, 128, [&](const glm::dvec3& way) { return 1 + glm::dot(b, way); });
    scene.background = glm::vec3(1);
    // The map's frame is turned by a quarter about y: b's x comes to lie along the world's z.
    scene.map_from_world = {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
    return scene;
}

void linear_skies(Findings& findings, Length /*length*/)
{
    for (const double angle : {0.0, 0.7, 2.0}) {
        const DeviceScene scene(plane_under_linear_sky(angle));
        const double expected = 0.5 * (1 + 2.0 / 3 * 0.8 * std::cos(angle));
        for (const bool light_sampling : {true, false}) {
            const Estimate mean = mean_of(rendered(scene, averaged(16, light_sampling, 2)));
            findings.at_most("brightest " + std::to_string(angle) + " off the normal, "
                    + (light_sampling ? "with" : "without")
                    + " light sampling: off 1/2 (a + 2/3 b . n) [standard errors]",
                std::abs(mean.mean - expected) / (mean.standard_error + 2e-4 * expected), 5);
        }
    }
}

Scene things_under(std::shared_ptr<const EnvironmentMap> map)
{
    Scene scene;
    scene.materials = {{"floor", glm::vec3(0.6F)},
        {.name = "metal", .albedo = glm::vec3(0.9F), .metallic = 1, .roughness = 0.3F}};
    scene.objects = {{"floor", 0, Quad{{-2, 0, -2}, {0, 0, 4}, {4, 0, 0}}},
        {"ball", 1, Sphere{{0, 0.5, 0}, 0.5}}};
    scene.environment = std::move(map);
    scene.background = glm::vec3(1);
    scene.camera = {{0, 0.8, -2.5}, {0, 0.6, 0}, {0, 1, 0}, 60};  // towards the seam
    return scene;
}

/// The same sky with its seam before the camera and behind it.
void seam(Findings& findings, Length length)
{
    const auto map = random_map(6, 4);
    auto shifted = std::make_shared<EnvironmentMap>(*map);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 6; ++x)
            shifted->texels[std::size_t{y} * 6 + x] = map->texels[std::size_t{y} * 6 + (x + 3) % 6];
    Scene turned = things_under(shifted);
    turned.map_from_world = {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    Rendering how = averaged(length == Length::kLong ? 256 : 16, true, 4);
    const Image ahead = rendered(things_under(map), how);
    how.settings.seed = 2;
    report_agreement(findings, "", agreement_of(ahead, rendered(turned, how)), 0.01);
    // Where the sky is seen itself there is no noise but that of a pixel's area.
    Scene sky = things_under(map);
    sky.objects.clear();
    Scene turned_sky = turned;
    turned_sky.objects.clear();
    how.settings.antialiasing = false;
    how.settings.denoiser = Denoiser::kOff;
    how.frames = 1;
    for (const double up : {0.0, 1.0, -1.0}) {
        sky.camera = turned_sky.camera = {{0, 0, 0}, {0, up, up == 0 ? 1 : 0}, {0, 1, 0}, 60};
        findings.at_most("sky that differs, looking " + std::to_string(static_cast<int>(up)),
            largest_off(difference_of(rendered(sky, how), rendered(turned_sky, how)), 0), 1e-5);
    }
}

void maps_that_say_nothing(Findings& findings, Length /*length*/)
{
    const Rendering how = averaged(2, true, 4);
    const auto black = map_of(8, 4, [](const glm::dvec3&) { return 0.0; });
    Scene dark = things_under(nullptr);
    dark.background = glm::vec3(0);
    findings.none("values that a black map changes",
        values_unlike(rendered(things_under(black), how), rendered(dark, how)));
    const auto grey = map_of(8, 4, [](const glm::dvec3&) { return 0.25; });
    const auto one = map_of(1, 1, [](const glm::dvec3&) { return 0.25; });
    Scene constant = things_under(nullptr);
    constant.background = glm::vec3(0.25F);
    const Image expected = rendered(constant, how);
    findings.none("values that a map of one colour changes",
        values_unlike(rendered(things_under(grey), how), expected));
    findings.none("values that a map of one texel changes",
        values_unlike(rendered(things_under(one), how), expected));
}

constexpr Case kEnvironmentCases[] = {
    {"44", "environment", "ends of a map's coordinates", Layer::kFunction,
        "Straight up, straight down, at the seam and anywhere a map shows what its texels say.",
        ends_of_coordinates},
    {"44b", "environment", "samples of hot maps", Layer::kFunction,
        "Samples of a map with one hot texel, at a pole or the seam, or of one texel, add up to "
        "its "
        "light.",
        samples_of_hot_maps},
    {"44c", "environment", "linear skies", Layer::kPicture,
        "A plane under a sky a + b . w shows albedo (a + 2/3 b . n).", linear_skies},
    {"44d", "environment", "a map's seam", Layer::kPicture,
        "A sky looks and lights the same wherever its map is cut open.", seam},
    {"44e", "environment", "maps that say nothing", Layer::kPicture,
        "A black map is none; a map of one colour is that colour.", maps_that_say_nothing},
};

constexpr Guard kEnvironmentGuards[] = {
    {"rows_end_at_poles", "44", "lights/environment.glsl",
        "const int upper = clamp(a.y, 0, size.y - 1);", "const int upper = a.y;"},
    {"columns_go_round", "44 44d", "lights/environment.glsl",
        "const int right = left + 1 < size.x ? left + 1 : 0;",
        "const int right = min(left + 1, size.x - 1);"},
    {"uniform_over_a_texel", "44b", "lights/environment.glsl",
        "const float t = mix(edges.x * edges.x, edges.y * edges.y, jitter.y);",
        "const float t = mix(edges.x, edges.y, jitter.y) * mix(edges.x, edges.y, jitter.y);"},
    {"map_of_one_color_is_none", "44e"},
    {"sky_met_by_chance_is_weighed", "44c", "path_trace/direct.glsl",
        "return radiance * chance_weight(bounce, pdf_light);", "return radiance;"},
};

}  // namespace

Group environment_group()
{
    return {kEnvironmentCases, kEnvironmentGuards};
}

}  // namespace farlight::lab
