// Path tracing stage: one frame's samples as separate signals.
#pragma once

#include "server/passes/gbuffer.h"
#include "server/render/settings.h"

namespace farlight {

/// Light at the first surface (rgba32f; alpha is the variance after a filter, see the shaders
/// before one).
struct Signals {
    TextureHandle direct;  ///< Diffuse, without the surface's albedo.
    TextureHandle indirect;  ///< Likewise.
    TextureHandle specular;  ///< Without its reflectance; only in scenes with something specular.
    TextureHandle shown;  ///< What the specular signal shows, to compare pixels by.
    TextureHandle scattered;  ///< On the way to the surface; only in fog.
};

inline Signals add_path_trace(FrameGraph& graph, const FrameInputs& inputs, const GBuffer& gbuffer,
    const RenderSettings& settings)
{
    Signals signals;
    signals.direct = graph.create("path_trace.direct", GL_RGBA32F);
    signals.indirect = graph.create("path_trace.indirect", GL_RGBA32F);
    if (inputs.has_specular()) {
        signals.specular = graph.create("path_trace.specular", GL_RGBA32F);
        signals.shown = graph.create("path_trace.shown", GL_RGBA32UI);
    }
    if (inputs.has_fog())
        signals.scattered = graph.create("path_trace.scattered", GL_RGBA32F);
    Pass& pass = graph.add_pass("path_trace", "path_trace/path_trace.comp")
                     .scene(inputs.scene)
                     .read("in_hit", gbuffer.hit)
                     .write("out_direct", signals.direct)
                     .write("out_indirect", signals.indirect)
                     .constant("samples_per_pixel", settings.samples_per_pixel)
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
    return signals;
}

}  // namespace farlight
