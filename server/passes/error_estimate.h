// Error estimate stage: how far the picture is from the truth, from its own samples. The host adds
// up what the passes sum over tiles (server/render/error_estimate.h).
#pragma once

#include "server/passes/accumulate.h"
#include "server/passes/composite.h"
#include "server/render/error_estimate.h"

namespace farlight {

/// Where in tile_block a pass writes its sums.
inline int tile_offset(TileSums sums, Extent extent)
{
    const Extent tiles = tiles_of(extent);
    return static_cast<int>(sums) * tiles.width * tiles.height;
}

/// What shaders that look at the filtered picture's noise read
/// (error_estimate/noise_of_picture.glsl).
inline void read_filtered(
    Pass& pass, const FrameInputs& inputs, const GBuffer& gbuffer, const Signals& filtered)
{
    read_signals(pass.define({{"ERROR_ESTIMATE", "1"}}), inputs, gbuffer, filtered);
}

/// `picture`: composite of `filtered`. `second_of_pair`: the frame before was the first.
inline void add_predict(FrameGraph& graph, const FrameInputs& inputs, const GBuffer& gbuffer,
    const Signals& noisy, const Signals& filtered,
    std::pair<TextureHandle, bool> picture_and_second_of_pair)
{
    const auto [picture, second_of_pair] = picture_and_second_of_pair;
    const History difference = graph.history("error_estimate.difference", GL_RGBA32F);
    Pass& pass = graph.add_pass("predict error", "error_estimate/predict.comp")
                     .read("in_picture", picture)
                     .read("noisy_direct", noisy.direct)
                     .read("noisy_indirect", noisy.indirect)
                     .read("in_motion", gbuffer.motion)
                     .read("prev_difference", difference.previous)
                     .write("out_difference", difference.current)
                     .constant("second_of_pair", second_of_pair ? 1 : 0)
                     .constant("tile_offset", tile_offset(TileSums::kPredicted, graph.extent()))
                     .dispatch(tiles_of(graph.extent()));
    read_filtered(pass, inputs, gbuffer, filtered);
    if (inputs.has_specular())
        pass.read("noisy_specular", noisy.specular);
    if (inputs.has_fog())
        pass.read("noisy_scattered", noisy.scattered);
}

/// Each pixel's predicted deviation relative to the picture (r32f).
inline TextureHandle add_deviation(FrameGraph& graph, const FrameInputs& inputs,
    const GBuffer& gbuffer, const Signals& filtered, TextureHandle picture)
{
    const TextureHandle deviation = graph.create("error_estimate.deviation", GL_R32F);
    Pass& pass = graph.add_pass("predicted deviation", "error_estimate/deviation.comp")
                     .read("in_picture", picture)
                     .write("out_deviation", deviation);
    read_filtered(pass, inputs, gbuffer, filtered);
    return deviation;
}

/// Each pixel's distance from the mean relative to it (r32f).
inline TextureHandle add_distance(FrameGraph& graph, TextureHandle picture, TextureHandle mean)
{
    const TextureHandle distance = graph.create("error_estimate.distance", GL_R32F);
    graph.add_pass("measured distance", "error_estimate/distance.comp")
        .read("in_picture", picture)
        .read("in_mean", mean)
        .write("out_distance", distance);
    return distance;
}

/// `picture`: the denoised one, if there is one and a reference to measure it against.
inline void add_measure(FrameGraph& graph, const FrameInputs& inputs, const GBuffer& gbuffer,
    const Mean& mean, TextureHandle picture)
{
    Pass& pass = graph.add_pass("measure error", "error_estimate/measure.comp")
                     .define({{"LIT", "1"}})
                     .read("in_albedo", gbuffer.albedo)
                     .read("in_mean", mean.radiance)
                     .constant("tile_offset", tile_offset(TileSums::kMeasured, graph.extent()))
                     .dispatch(tiles_of(graph.extent()));
    if (inputs.has_fog())
        pass.define({{"FX_FOG", "1"}})
            .read("in_fog_way", gbuffer.fog_way)
            .constant("fog_sigma_t", inputs.fog.sigma_t);
    if (picture.index >= 0)
        pass.define({{"WITH_REFERENCE", "1"}})
            .read("in_picture", picture)
            .read("in_reference", mean.prev_reference);
}

}  // namespace farlight
