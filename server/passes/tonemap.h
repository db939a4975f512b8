// Tonemap stage: scene-linear radiance to sRGB.
#pragma once

#include "server/render/frame_graph.h"
#include "server/render/settings.h"

namespace farlight {

/// For passes that look at the picture as it is shown.
inline void add_tone_constants(Pass& pass, const RenderSettings& settings)
{
    pass.constant("exposure", settings.exposure)
        .constant("tonemap_curve", settings.tonemap == Tonemap::kAces ? 0 : 1);
}

inline TextureHandle add_tonemap(
    FrameGraph& graph, TextureHandle radiance, const RenderSettings& settings)
{
    const TextureHandle display = graph.create("display", GL_RGBA8);
    Pass& pass = graph.add_pass("tonemap", "tonemap/tonemap.comp")
                     .read("in_radiance", radiance)
                     .write("out_display", display);
    add_tone_constants(pass, settings);
    return display;
}

}  // namespace farlight
