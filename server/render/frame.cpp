// The frame at a glance: which stages run, and what feeds what.
#include "server/render/frame.h"

#include "server/passes/accumulate.h"
#include "server/passes/composite.h"
#include "server/passes/debug_view.h"
#include "server/passes/error_estimate.h"
#include "server/passes/flip.h"
#include "server/passes/gbuffer.h"
#include "server/passes/path_trace.h"
#include "server/passes/svgf.h"
#include "server/passes/tonemap.h"

namespace farlight {
namespace {

/// The picture of a debug view, or nothing when the view is the finished picture.
std::optional<TextureHandle> add_debug_view(
    FrameGraph& graph, const FrameBuffers& buffers, const FramePlan& plan)
{
    const ViewScales scales{plan.settings.exposure, plan.scene_radius,
        static_cast<float>(plan.settings.history_max), plan.linear_output, plan.origin};
    // A sheet has no numbers of its own: raw frames of it hold the picture's.
    if (plan.settings.view == DebugView::kFinal
        || (plan.settings.view == DebugView::kSheet && plan.linear_output))
        return std::nullopt;
    if (plan.settings.view == DebugView::kSheet)
        return add_debug_sheet(graph, buffers, scales);
    const ViewRecipe recipe = recipe_of(plan.settings.view, buffers, scales);
    const TextureHandle value = add_debug_value(graph, "debug_view", recipe);
    return plan.linear_output ? value : add_debug_display(graph, "debug_view", recipe, value);
}

bool is_lit(const FramePlan& plan)
{
    return plan.scatters && plan.settings.max_depth > 1;
}

bool shows_raw(DebugView view)
{
    return view == DebugView::kRawRadiance || view == DebugView::kSheet || view == DebugView::kWipe;
}

/// From samples to the denoised picture, and what it says of its error.
void add_denoiser(
    FrameGraph& graph, const FrameInputs& inputs, const FramePlan& plan, FrameBuffers& buffers)
{
    const SvgfOutput svgf = add_svgf(graph, inputs, buffers.gbuffer, buffers.noisy, plan.settings);
    buffers.blended = svgf.blended;
    buffers.history_length = svgf.history_length;
    buffers.denoised = add_composite(graph, "composite", inputs, buffers.gbuffer, svgf.filtered);
    if (plan.looks.predicts)
        add_predict(graph, inputs, buffers.gbuffer, buffers.noisy, svgf.filtered,
            {buffers.denoised, plan.looks.second_of_pair});
    if (plan.settings.error_estimate && plan.settings.view == DebugView::kPredictedDeviation)
        buffers.deviation =
            add_deviation(graph, inputs, buffers.gbuffer, svgf.filtered, buffers.denoised);
}

/// The running mean, and the picture that turns into it.
TextureHandle add_mean(
    FrameGraph& graph, const FrameInputs& inputs, const FramePlan& plan, FrameBuffers& buffers)
{
    const Mean mean = add_accumulate(graph, buffers.raw, plan.mean_frames, plan.looks.reference);
    buffers.mean = mean.radiance;
    if (plan.looks.measures)
        add_measure(graph, inputs, buffers.gbuffer, mean,
            plan.looks.measured_against > 0 ? buffers.denoised : TextureHandle{});
    if (plan.settings.view == DebugView::kMeasuredError && is_denoised(plan))
        buffers.distance = add_distance(graph, buffers.denoised, mean.radiance);
    if (plan.settings.view == DebugView::kFlip && is_denoised(plan))
        buffers.flip =
            add_flip(graph, buffers.denoised, mean.radiance, plan.settings, plan.keeps_flip);
    return is_denoised(plan)
        ? add_refine(graph, buffers.denoised, mean.radiance, static_cast<float>(mean_weight(plan)))
        : mean.radiance;
}

}  // namespace

bool is_denoised(const FramePlan& plan)
{
    return plan.settings.denoiser == Denoiser::kSvgf && is_lit(plan);
}

bool is_averaged(const FramePlan& plan)
{
    return plan.settings.denoiser == Denoiser::kAccumulate || plan.refine;
}

double mean_weight(const FramePlan& plan)
{
    if (!is_averaged(plan))
        return 0;
    const double samples = static_cast<double>(plan.mean_frames) * plan.settings.samples_per_pixel;
    return is_denoised(plan) ? samples / (samples + plan.settings.refine_crossover) : 1;
}

std::vector<ActiveEffect> effects_by_settings(const FramePlan& plan)
{
    std::vector<ActiveEffect> called;
    if (is_averaged(plan) && plan.settings.antialiasing)
        called.push_back({"antialiasing", "FX_ANTIALIASING",
            plan.refine ? "setting antialiasing = true, in a picture that rests"
                        : "setting antialiasing = true, with denoiser = accumulate"});
    if (is_denoised(plan))
        called.push_back({"denoising", "", "setting denoiser = svgf"});
    return called;
}

TextureHandle build_frame(FrameGraph& graph, const FrameInputs& inputs, const FramePlan& plan)
{
    const RenderSettings& settings = plan.settings;
    const bool paints = settings.view == DebugView::kBadValues;
    if (paints)
        graph.define_for_all({{"PAINTS_BAD_VALUES", "1"}});
    const bool denoises = is_denoised(plan);
    FrameBuffers buffers;
    buffers.gbuffer = add_gbuffer(graph, inputs, denoises);
    if (is_lit(plan))
        buffers.noisy = add_path_trace(graph, inputs, buffers.gbuffer, settings);
    if (!denoises || is_averaged(plan) || shows_raw(settings.view))
        buffers.raw = add_composite(graph, "composite raw", inputs, buffers.gbuffer, buffers.noisy);
    buffers.denoised = buffers.raw;
    if (denoises)
        add_denoiser(graph, inputs, plan, buffers);
    const TextureHandle radiance =
        is_averaged(plan) ? add_mean(graph, inputs, plan, buffers) : buffers.denoised;

    if (paints)
        return plan.linear_output ? add_bad_value_numbers(graph)
                                  : add_bad_values(graph, add_tonemap(graph, radiance, settings));
    if (settings.view == DebugView::kWipe) {
        const TextureHandle wipe = add_wipe(graph, buffers, settings);
        return plan.linear_output ? wipe : add_tonemap(graph, wipe, settings);
    }
    if (const auto debug = add_debug_view(graph, buffers, plan))
        return *debug;
    return plan.linear_output ? radiance : add_tonemap(graph, radiance, settings);
}

}  // namespace farlight
