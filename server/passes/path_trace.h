// Path tracing stage: one frame's samples as separate signals.
#pragma once

#include "server/passes/gbuffer.h"
#include "server/render/settings.h"

#include <algorithm>
#include <string>
#include <utility>

namespace farlight {

/// Light at the first surface (rgba32f; after a filter alpha is its noise, shaders/svgf/noise.glsl;
/// before one see the shaders).
struct Signals {
    TextureHandle direct;  ///< Diffuse, without the surface's albedo.
    TextureHandle indirect;  ///< Likewise.
    TextureHandle specular;  ///< Without its reflectance; only in scenes with something specular.
    TextureHandle shown;  ///< What the specular signal shows, to compare pixels by.
    TextureHandle scattered;  ///< On the way to the surface; only in fog.
};

/// Path segments a pixel that one dispatch traces: as many samples as fit, at least one, whose
/// paths are never split. llvmpipe ends all loops of an invocation,
/// without a word, after 65535 rounds together: this leaves 256 rounds for the rays of a segment,
/// four times what a million triangles take. On hardware it keeps a dispatch clear of the driver's
/// watchdog.
constexpr int kSegmentsPerDispatch = 256;
/// Where surfaces have holes every one on a ray's way takes some rounds: this leaves 2048. A single
/// sample may have up to 128 segments, two paths of 64 in fog: the longest there are get 512,
/// enough for 48 holes on each ray.
constexpr int kSegmentsThroughHoles = 32;

/// Follows from the scene, not from the program: sums in another order are other bits.
inline int samples_per_dispatch(const RenderSettings& settings, const FrameInputs& inputs)
{
    const glm::vec3& sigma_t = inputs.fog.sigma_t;
    const int paths_per_sample = std::max({sigma_t.x, sigma_t.y, sigma_t.z}) > 0 ? 2 : 1;
    const int segments = inputs.holes ? kSegmentsThroughHoles : kSegmentsPerDispatch;
    return std::max(segments / (settings.max_depth * paths_per_sample), 1);
}

/// `samples` more samples a pixel, averaged with the `samples_before` that `before` holds.
inline Signals add_path_trace_part(FrameGraph& graph, const FrameInputs& inputs,
    const GBuffer& gbuffer, const RenderSettings& settings, const Signals* before,
    std::pair<int, int> samples_before_and_now)
{
    const auto [samples_before, samples] = samples_before_and_now;
    Signals signals;
    signals.direct = graph.create("path_trace.direct", GL_RGBA32F);
    signals.indirect = graph.create("path_trace.indirect", GL_RGBA32F);
    if (inputs.has_specular()) {
        signals.specular = graph.create("path_trace.specular", GL_RGBA32F);
        signals.shown = graph.create("path_trace.shown", GL_RGBA32UI);
    }
    if (inputs.has_fog())
        signals.scattered = graph.create("path_trace.scattered", GL_RGBA32F);
    const std::string name = before == nullptr
        ? "path_trace"
        : "path_trace from sample " + std::to_string(samples_before);
    Pass& pass = graph.add_pass(name, "path_trace/path_trace.comp")
                     .scene(inputs.scene)
                     .read("in_hit", gbuffer.hit)
                     .write("out_direct", signals.direct)
                     .write("out_indirect", signals.indirect)
                     .constant("samples_per_pixel", samples)
                     .constant("max_depth", settings.max_depth)
                     .constant("roulette_depth", settings.roulette_depth);
    inputs.add_primary_ray_constants(pass);
    if (inputs.scene.calls_for("FX_LIGHTS"))
        pass.constant("light_sampling", settings.light_sampling ? 1 : 0);
    if (inputs.has_specular())
        pass.read("in_reflectance", gbuffer.reflectance)
            .write("out_specular", signals.specular)
            .write("out_shown", signals.shown);
    if (inputs.has_fog()) {
        inputs.add_fog_sphere(pass);
        pass.write("out_scattered", signals.scattered)
            .constant("fog_sigma_t", inputs.fog.sigma_t)
            .constant("fog_sigma_s", inputs.fog.sigma_s)
            .constant("fog_g", inputs.fog.g);
    }
    if (before != nullptr) {
        pass.define({{"CONTINUES", "1"}})
            .constant("samples_before", samples_before)
            .read("in_direct", before->direct)
            .read("in_indirect", before->indirect);
        if (inputs.has_specular())
            pass.read("in_specular", before->specular).read("in_shown", before->shown);
        if (inputs.has_fog())
            pass.read("in_scattered", before->scattered);
    }
    return signals;
}

inline Signals add_path_trace(FrameGraph& graph, const FrameInputs& inputs, const GBuffer& gbuffer,
    const RenderSettings& settings)
{
    const int wanted = settings.samples_per_pixel;
    const int at_once = samples_per_dispatch(settings, inputs);
    Signals signals = add_path_trace_part(
        graph, inputs, gbuffer, settings, nullptr, {0, std::min(at_once, wanted)});
    for (int traced = at_once; traced < wanted; traced += at_once)
        signals = add_path_trace_part(graph, inputs, gbuffer, settings, &signals,
            {traced, std::min(at_once, wanted - traced)});
    return signals;
}

}  // namespace farlight
