// Accumulate stage: the running mean of raw pictures, and the blend of a resting picture towards
// it.
#pragma once

#include "server/host_guard.h"
#include "server/render/frame_graph.h"

namespace farlight {

inline const HostGuard means_in_32_bits("means_in_32_bits");

/// Of a running mean. In 16 bits it stops following after some thousand frames: what a frame adds
/// is below its rounding.
inline GLenum mean_format()
{
    return means_in_32_bits ? GL_RGBA32F : GL_RGBA16F;
}

/// Contents: shaders/accumulate/accumulate.comp.
struct Mean {
    TextureHandle radiance;
    TextureHandle prev_reference;  ///< Mean of older samples, as last frame had it.
};

/// What becomes of the older mean that a denoised picture is measured against.
enum class Reference : std::uint8_t {
    kAbsent,  ///< Nobody measures.
    kKeep,
    kTake,  ///< This frame's mean is the next frames' reference.
};

/// `frame_count`: frames in the mean including this one.
inline Mean add_accumulate(
    FrameGraph& graph, TextureHandle raw, int frame_count, Reference reference)
{
    const History mean = graph.history("accumulate.mean", mean_format());
    const History variance = graph.history("accumulate.variance", mean_format());
    Pass& pass = graph.add_pass("accumulate", "accumulate/accumulate.comp")
                     .read("in_radiance", raw)
                     .read("prev_mean", mean.previous)
                     .read("prev_variance", variance.previous)
                     .write("out_mean", mean.current)
                     .write("out_variance", variance.current)
                     .constant("frame_count", mean.valid && variance.valid ? frame_count : 1);
    if (reference == Reference::kAbsent)
        return {mean.current, {}};
    const History older = graph.history("accumulate.reference", mean_format());
    pass.define({{"WITH_REFERENCE", "1"}})
        .read("prev_reference", older.previous)
        .write("out_reference", older.current)
        .constant("takes_reference", reference == Reference::kTake ? 1 : 0);
    return {mean.current, older.previous};
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
