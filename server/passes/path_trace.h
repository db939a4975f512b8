// Path tracing stage: one frame's samples as separate signals.
#pragma once

#include "server/passes/gbuffer.h"
#include "server/render/settings.h"

namespace farlight {

/// Light at the first surface without that surface's albedo (rgba32f; alpha is the variance after a
/// filter).
struct Signals {
    TextureHandle direct;
    TextureHandle indirect;
};

inline Signals add_path_trace(FrameGraph& graph, const SceneInputs& scene, const GBuffer& gbuffer,
    const RenderSettings& settings)
{
    const Signals signals{graph.create("path_trace.direct", GL_RGBA32F),
        graph.create("path_trace.indirect", GL_RGBA32F)};
    Pass& pass = graph.add_pass("path_trace", "path_trace/path_trace.comp")
                     .scene(scene)
                     .read("in_surface", gbuffer.surface)
                     .read("in_identity", gbuffer.identity)
                     .read("in_position", gbuffer.position)
                     .write("out_direct", signals.direct)
                     .write("out_indirect", signals.indirect)
                     .constant("samples_per_pixel", settings.samples_per_pixel)
                     .constant("max_depth", settings.max_depth)
                     .constant("roulette_depth", settings.roulette_depth);
    if (scene.calls_for("FX_LIGHTS"))
        pass.constant("light_sampling", settings.light_sampling ? 1 : 0);
    return signals;
}

}  // namespace farlight
