// Accumulate stage: the running mean of raw pictures, and the blend of a resting picture towards
// it.
#pragma once

#include "server/render/frame_graph.h"

namespace farlight {

/// `frame_count`: frames in the mean including this one.
inline TextureHandle add_accumulate(FrameGraph& graph, TextureHandle raw, int frame_count)
{
    const History mean = graph.history("accumulate.mean", GL_RGBA32F);
    graph.add_pass("accumulate", "accumulate/accumulate.comp")
        .read("in_radiance", raw)
        .read("prev_mean", mean.previous)
        .write("out_mean", mean.current)
        .constant("frame_count", mean.valid ? frame_count : 1);
    return mean.current;
}

inline TextureHandle add_refine(
    FrameGraph& graph, TextureHandle denoised, TextureHandle mean, float mean_weight)
{
    const TextureHandle refined = graph.create("refine", GL_RGBA32F);
    graph.add_pass("refine", "accumulate/refine.comp")
        .read("in_denoised", denoised)
        .read("in_mean", mean)
        .write("out_radiance", refined)
        .constant("mean_weight", mean_weight);
    return refined;
}

}  // namespace farlight
