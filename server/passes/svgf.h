// SVGF stage: temporal accumulation, variance estimation, a-trous wavelet filter (Schied et al.
// 2017).
#pragma once

#include "server/passes/path_trace.h"

#include <algorithm>

namespace farlight {

/// What the filter leaves behind, for the composite and for people who look inside.
struct SvgfOutput {
    Signals filtered;
    Signals blended;  ///< Before the wavelet filter; alpha is the variance estimate.
    TextureHandle history_length;
};

struct SvgfHistories {
    History direct;
    History indirect;
    History moments;
    History length;
};

inline Signals add_svgf_temporal(FrameGraph& graph, const GBuffer& gbuffer, const Signals& noisy,
    const SvgfHistories& past, const Signals& blended, const RenderSettings& settings)
{
    const bool valid = past.direct.valid && past.moments.valid && gbuffer.history_valid;
    graph.add_pass("svgf temporal", "svgf/temporal.comp")
        .read("in_direct", noisy.direct)
        .read("in_indirect", noisy.indirect)
        .read("in_surface", gbuffer.surface)
        .read("in_identity", gbuffer.identity)
        .read("in_position", gbuffer.position)
        .read("in_motion", gbuffer.motion)
        .read("prev_direct", past.direct.previous)
        .read("prev_indirect", past.indirect.previous)
        .read("prev_moments", past.moments.previous)
        .read("prev_length", past.length.previous)
        .read("prev_surface", gbuffer.prev_surface)
        .read("prev_identity", gbuffer.prev_identity)
        .write("out_direct", blended.direct)
        .write("out_indirect", blended.indirect)
        .write("out_moments", past.moments.current)
        .write("out_length", past.length.current)
        .constant("history_valid", valid ? 1 : 0)
        .constant("history_max", settings.history_max)
        .constant("svgf_alpha", settings.svgf_alpha)
        .constant("svgf_moments_alpha", settings.svgf_moments_alpha)
        .constant("reproject_depth", settings.reproject_depth)
        .constant("reproject_normal", settings.reproject_normal);
    return blended;
}

inline Signals add_svgf_variance(FrameGraph& graph, const GBuffer& gbuffer, const Signals& blended,
    const SvgfHistories& past, const RenderSettings& settings)
{
    const Signals estimated{
        graph.create("svgf.direct", GL_RGBA32F), graph.create("svgf.indirect", GL_RGBA32F)};
    graph.add_pass("svgf variance", "svgf/variance.comp")
        .read("in_direct", blended.direct)
        .read("in_indirect", blended.indirect)
        .read("in_moments", past.moments.current)
        .read("in_length", past.length.current)
        .read("in_surface", gbuffer.surface)
        .write("out_direct", estimated.direct)
        .write("out_indirect", estimated.indirect)
        .constant("svgf_spatial_frames", settings.svgf_spatial_frames)
        .constant("sigma_depth", settings.sigma_depth)
        .constant("sigma_normal", settings.sigma_normal);
    return estimated;
}

/// One a-trous iteration into `filtered`; `iteration` 1, 2, 3, ... filters with taps 1, 2, 4, ...
/// pixels apart.
inline void add_svgf_atrous(FrameGraph& graph, const GBuffer& gbuffer, const Signals& noisy,
    const Signals& filtered, int iteration, const RenderSettings& settings)
{
    graph.add_pass("svgf a-trous " + std::to_string(iteration), "svgf/atrous.comp")
        .read("in_direct", noisy.direct)
        .read("in_indirect", noisy.indirect)
        .read("in_surface", gbuffer.surface)
        .write("out_direct", filtered.direct)
        .write("out_indirect", filtered.indirect)
        .constant("step_size", 1 << (iteration - 1))
        .constant("sigma_depth", settings.sigma_depth)
        .constant("sigma_normal", settings.sigma_normal)
        .constant("sigma_luminance", settings.sigma_luminance);
}

inline SvgfOutput add_svgf(
    FrameGraph& graph, const GBuffer& gbuffer, const Signals& noisy, const RenderSettings& settings)
{
    const SvgfHistories past{graph.history("svgf.history_direct", GL_RGBA32F),
        graph.history("svgf.history_indirect", GL_RGBA32F),
        graph.history("svgf.moments", GL_RGBA32F), graph.history("svgf.length", GL_R32F)};
    const Signals feedback{past.direct.current, past.indirect.current};
    const auto fresh = [&] {
        return Signals{
            graph.create("svgf.direct", GL_RGBA32F), graph.create("svgf.indirect", GL_RGBA32F)};
    };

    // The output of this iteration becomes history; 0: the unfiltered blend does.
    const int feedback_iteration =
        std::min(settings.svgf_feedback_iteration, settings.atrous_iterations);
    const Signals blended = add_svgf_temporal(
        graph, gbuffer, noisy, past, feedback_iteration == 0 ? feedback : fresh(), settings);
    SvgfOutput output;
    output.history_length = past.length.current;
    output.blended = add_svgf_variance(graph, gbuffer, blended, past, settings);
    output.filtered = output.blended;
    for (int i = 1; i <= settings.atrous_iterations; ++i) {
        const Signals filtered = i == feedback_iteration ? feedback : fresh();
        add_svgf_atrous(graph, gbuffer, output.filtered, filtered, i, settings);
        output.filtered = filtered;
    }
    return output;
}

}  // namespace farlight
