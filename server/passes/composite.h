// Composite stage: the signals put back together.
#pragma once

#include "server/passes/path_trace.h"

namespace farlight {

/// What composite/compose.glsl reads to make a picture of `light`.
inline void read_signals(
    Pass& pass, const FrameInputs& inputs, const GBuffer& gbuffer, const Signals& light)
{
    const bool lit = light.direct.index >= 0;
    if (lit)
        pass.define({{"LIT", "1"}})
            .read("in_direct", light.direct)
            .read("in_indirect", light.indirect)
            .read("in_albedo", gbuffer.albedo);
    if (lit && inputs.has_specular())
        pass.define({{"FX_SPECULAR_SIGNAL", "1"}})
            .read("in_specular", light.specular)
            .read("in_reflectance", gbuffer.reflectance);
    if (inputs.has_fog())
        pass.define({{"FX_FOG", "1"}})
            .read("in_fog_way", gbuffer.fog_way)
            .constant("fog_sigma_t", inputs.fog.sigma_t);
    if (lit && inputs.has_fog())
        pass.read("in_scattered", light.scattered);
}

/// Scene-linear radiance (rgba32f). `name` tells the raw picture from the denoised one. Without
/// signals (no light scatters) only emission is seen.
inline TextureHandle add_composite(FrameGraph& graph, const std::string& name,
    const FrameInputs& inputs, const GBuffer& gbuffer, const Signals& light)
{
    const TextureHandle radiance = graph.create(name, GL_RGBA32F);
    Pass& pass = graph.add_pass(name, "composite/composite.comp")
                     .read("in_emission", gbuffer.emission)
                     .write("out_radiance", radiance);
    read_signals(pass, inputs, gbuffer, light);
    return radiance;
}

}  // namespace farlight
