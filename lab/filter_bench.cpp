// See the header.
#include "lab/filter_bench.h"

#include "server/render/settings.h"

#include <bit>

namespace farlight::lab {
namespace {

/// Object 0 of material 0, normal towards the camera, met.
constexpr glm::uvec4 kWallIdentity{0, 0, 0, 1};

void add_past(PassBench& bench, const RenderSettings& settings)
{
    for (const char* name :
        {"prev_light", "prev_light_2", "prev_moments", "prev_length", "out_moments", "out_length"})
        bench.fill(name, GL_RGBA32F, glm::vec4(0));
    bench.fill("in_motion", GL_RGBA32F, glm::vec4(0, 0, 0, 1));
    bench.fill_bits("in_identity", GL_RGBA32UI, kWallIdentity);
    bench.fill_bits("prev_identity", GL_RGBA32UI, kWallIdentity);
    bench.fill_bits("prev_surface", GL_RGBA32UI, wall_at(kWallDepth));
    bench.constant("history_valid", 1);
    bench.constant("history_max", settings.history_max);
    bench.constant("svgf_alpha", settings.svgf_alpha);
    bench.constant("svgf_moments_alpha", settings.svgf_moments_alpha);
    bench.constant("reproject_depth", settings.reproject_depth);
    bench.constant("reproject_normal", settings.reproject_normal);
}

}  // namespace

glm::uvec4 wall_at(float depth)
{
    return {std::bit_cast<std::uint32_t>(depth), 0, 0, 0};
}

std::unique_ptr<PassBench> filter_bench(const std::string& name, Extent extent)
{
    const RenderSettings settings;
    auto bench = std::make_unique<PassBench>(
        "svgf/" + name + ".comp", Defines{{"SIGNAL_DIFFUSE", "1"}}, extent);
    for (const char* light : {"in_light", "in_light_2", "out_light", "out_light_2"})
        bench->fill(light, GL_RGBA32F, glm::vec4(0));
    bench->fill_bits("in_surface", GL_RGBA32UI, wall_at(kWallDepth));
    if (name == "temporal") {
        add_past(*bench, settings);
        return bench;
    }
    bench->constant("sigma_depth", settings.sigma_depth);
    bench->constant("sigma_normal", settings.sigma_normal);
    if (name == "variance") {
        bench->fill("in_moments", GL_RGBA32F, glm::vec4(0));
        bench->fill("in_length", GL_R32F, glm::vec4(1));
        bench->constant("svgf_spatial_frames", settings.svgf_spatial_frames);
    } else {
        bench->constant("step_size", 1);
        bench->constant("sigma_luminance", settings.sigma_luminance);
    }
    return bench;
}

float noise_word(float variance)
{
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(variance) & 0xffff0000U);
}

float variance_of(float noise_word)
{
    return lab::noise_word(noise_word);
}

}  // namespace farlight::lab
