// Composite stage: albedo * light + emission.
#pragma once

#include "server/passes/path_trace.h"

namespace farlight {

/// Scene-linear radiance (rgba32f). `name` tells the raw picture from the denoised one.
inline TextureHandle add_composite(
    FrameGraph& graph, const std::string& name, const GBuffer& gbuffer, const Signals& light)
{
    const TextureHandle radiance = graph.create(name, GL_RGBA32F);
    graph.add_pass(name, "composite/composite.comp")
        .read("in_direct", light.direct)
        .read("in_indirect", light.indirect)
        .read("in_albedo", gbuffer.albedo)
        .read("in_emission", gbuffer.emission)
        .write("out_radiance", radiance);
    return radiance;
}

}  // namespace farlight
