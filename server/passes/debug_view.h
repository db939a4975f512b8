// Debug view stage: any buffer of the frame, as numbers (for `raw` frames) and as colours.
#pragma once

#include "server/passes/path_trace.h"

namespace farlight {

/// Everything a view may show; what a frame does not have stays at index -1.
struct FrameBuffers {
    GBuffer gbuffer;
    Signals noisy;
    TextureHandle raw;  ///< Undenoised picture.
    Signals blended;  ///< SVGF: alpha holds the variance estimate.
    TextureHandle history_length;
    TextureHandle denoised;  ///< The picture before it is refined; the raw one without a filter.
    TextureHandle mean;  ///< Of a resting picture.
    TextureHandle deviation;  ///< Predicted, of each pixel; only where the view shows it.
    TextureHandle distance;  ///< Of each pixel of `denoised` from `mean`; likewise.
    TextureHandle flip;  ///< Between `denoised` and `mean`; likewise.
};

struct ViewScales {
    float exposure;
    float scene_radius;
    float history_max;
    bool linear;  ///< Numbers are wanted, not colours.
    glm::dvec3 origin;  ///< From where the device counts positions.
};

/// Share of a pixel's brightness that is shown white by views of errors.
constexpr float kHottest = 0.5F;

/// How one view is read, shown, and what counts as large in it.
struct ViewRecipe {
    TextureHandle source;
    const char* read_as;
    const char* show_as;
    float scale;
    TextureHandle second = {};  ///< VIEW_VARIANCE adds the indirect signal's.
    glm::vec3 origin{0};  ///< VIEW_POSITION adds it.
};

/// Positions as the scene's file counts them. Cells of colours repeat: what of the origin is whole
/// cells is left out, so that colours are as exact as anywhere.
inline ViewRecipe position_recipe(TextureHandle position, const ViewScales& scales)
{
    const double cell = 0.25 * static_cast<double>(scales.scene_radius);
    const glm::dvec3 within = glm::mod(scales.origin, cell);
    return {position, "VIEW_POSITION", "SHOW_FRACTION", static_cast<float>(cell), {},
        glm::vec3(scales.linear ? scales.origin : within)};
}

/// How `view` is shown. Without its buffer (no denoiser: no history) the view is zero everywhere.
inline ViewRecipe recipe_of(DebugView view, const FrameBuffers& b, const ViewScales& scales)
{
    const auto recipe = [&]() -> ViewRecipe {
        switch (view) {
        case DebugView::kRawRadiance:
            return {b.raw, "VIEW_COLOR", "SHOW_RADIANCE", scales.exposure};
        case DebugView::kDirect:
            return {b.noisy.direct, "VIEW_COLOR", "SHOW_RADIANCE", scales.exposure};
        case DebugView::kIndirect:
            return {b.noisy.indirect, "VIEW_COLOR", "SHOW_RADIANCE", scales.exposure};
        case DebugView::kSpecular:
            return {b.noisy.specular, "VIEW_COLOR", "SHOW_RADIANCE", scales.exposure};
        case DebugView::kScattered:
            return {b.noisy.scattered, "VIEW_COLOR", "SHOW_RADIANCE", scales.exposure};
        case DebugView::kAlbedo: return {b.gbuffer.albedo, "VIEW_COLOR", "SHOW_RADIANCE", 1};
        case DebugView::kEmission:
            return {b.gbuffer.emission, "VIEW_COLOR", "SHOW_RADIANCE", scales.exposure};
        case DebugView::kDepth:
            return {b.gbuffer.surface, "VIEW_DEPTH", "SHOW_DISTANCE", 2 * scales.scene_radius};
        case DebugView::kDepthGradient:
            return {b.gbuffer.surface, "VIEW_GRADIENT", "SHOW_MOTION", 0.01F * scales.scene_radius};
        case DebugView::kPosition: return position_recipe(b.gbuffer.position, scales);
        case DebugView::kGeometricNormal:
            return {b.gbuffer.identity, "VIEW_GEOMETRIC", "SHOW_NORMAL", 1};
        case DebugView::kShadingNormal:
            return {b.gbuffer.surface, "VIEW_SHADING", "SHOW_NORMAL", 1};
        case DebugView::kObjectId: return {b.gbuffer.identity, "VIEW_OBJECT", "SHOW_ID", 1};
        case DebugView::kMaterialId: return {b.gbuffer.identity, "VIEW_MATERIAL", "SHOW_ID", 1};
        case DebugView::kMotion: return {b.gbuffer.motion, "VIEW_COLOR", "SHOW_MOTION", 16};
        case DebugView::kVariance:
            return {b.blended.direct, "VIEW_VARIANCE", "SHOW_RADIANCE", scales.exposure,
                b.blended.indirect};
        case DebugView::kHistoryLength:
            return {b.history_length, "VIEW_RED", "SHOW_COUNT", scales.history_max};
        case DebugView::kPredictedDeviation:
            return {b.deviation, "VIEW_RED", "SHOW_HEAT", kHottest};
        case DebugView::kMeasuredError: return {b.distance, "VIEW_RED", "SHOW_HEAT", kHottest};
        case DebugView::kFlip: return {b.flip, "VIEW_RED", "SHOW_MAGMA", 1};
        case DebugView::kFinal:
        case DebugView::kSheet:
        case DebugView::kWipe:
        case DebugView::kBadValues: break;
        }
        return {{}, nullptr, "SHOW_NORMAL", 1};
    }();
    return recipe.source.index < 0 ? ViewRecipe{{}, "VIEW_NOTHING", recipe.show_as, recipe.scale}
                                   : recipe;
}

/// The two sides of the wipe in one picture (rgba32f). While there is no mean, a frame's own
/// samples are the mean of one.
inline TextureHandle add_wipe(
    FrameGraph& graph, const FrameBuffers& buffers, const RenderSettings& settings)
{
    const auto shown = [&](WipeSide side) {
        const TextureHandle picture = side == WipeSide::kDenoised ? buffers.denoised
            : side == WipeSide::kAccumulated                      ? buffers.mean
                                                                  : buffers.raw;
        return picture.index < 0 ? buffers.raw : picture;
    };
    const TextureHandle wipe = graph.create("wipe", GL_RGBA32F);
    graph.add_pass("wipe", "debug_view/wipe.comp")
        .read("in_left", shown(settings.wipe_left))
        .read("in_right", shown(settings.wipe_right))
        .write("out_radiance", wipe)
        .constant("wipe_position", settings.wipe_position);
    return wipe;
}

/// The view's numbers (rgba32f).
inline TextureHandle add_debug_value(
    FrameGraph& graph, const std::string& name, const ViewRecipe& recipe)
{
    const TextureHandle value = graph.create(name + ".value", GL_RGBA32F);
    Pass& pass = graph.add_pass(name + " value", "debug_view/value.comp")
                     .define({{recipe.read_as, ""}})
                     .write("out_value", value);
    if (recipe.source.index >= 0)
        pass.read("in_texture", recipe.source);
    if (recipe.second.index >= 0)
        pass.read("in_second", recipe.second);
    if (recipe.read_as == std::string_view("VIEW_POSITION"))
        pass.constant("origin", recipe.origin);
    return value;
}

/// The view's colours (rgba8).
inline TextureHandle add_debug_display(
    FrameGraph& graph, const std::string& name, const ViewRecipe& recipe, TextureHandle value)
{
    const TextureHandle display = graph.create(name + ".display", GL_RGBA8);
    Pass& pass = graph.add_pass(name + " display", "debug_view/display.comp")
                     .define({{recipe.show_as, ""}})
                     .read("in_value", value)
                     .write("out_display", display);
    const std::string_view show_as = recipe.show_as;
    if (show_as != "SHOW_NORMAL" && show_as != "SHOW_ID")
        pass.constant("value_scale", recipe.scale);
    return display;
}

/// Where the passes before met values that no healthy frame has, over the dimmed picture `display`.
inline TextureHandle add_bad_values(FrameGraph& graph, TextureHandle display)
{
    const TextureHandle painted = graph.create("bad values", GL_RGBA8);
    graph.add_pass("bad values", "debug_view/bad_values.comp")
        .wait_for_blocks()
        .read("in_display", display)
        .write("out_display", painted);
    return painted;
}

/// The same as numbers (rgba32f).
inline TextureHandle add_bad_value_numbers(FrameGraph& graph)
{
    const TextureHandle numbers = graph.create("bad values.value", GL_RGBA32F);
    graph.add_pass("bad values value", "debug_view/bad_values.comp")
        .define({{"NUMBERS", "1"}})
        .wait_for_blocks()
        .write("out_value", numbers);
    return numbers;
}

/// Radiance, normal, variance, history length; where a quadrant's buffer is missing the radiance
/// stands in.
inline TextureHandle add_debug_sheet(
    FrameGraph& graph, const FrameBuffers& buffers, const ViewScales& scales)
{
    const auto quadrant = [&](DebugView view, const char* name) {
        const ViewRecipe recipe = recipe_of(view, buffers, scales);
        return add_debug_display(graph, name, recipe, add_debug_value(graph, name, recipe));
    };
    const TextureHandle top_left = quadrant(DebugView::kRawRadiance, "sheet radiance");
    const TextureHandle top_right = quadrant(DebugView::kShadingNormal, "sheet normal");
    const TextureHandle bottom_left = quadrant(DebugView::kVariance, "sheet variance");
    const TextureHandle bottom_right = quadrant(DebugView::kHistoryLength, "sheet history");
    const TextureHandle display = graph.create("sheet", GL_RGBA8);
    graph.add_pass("sheet", "debug_view/sheet.comp")
        .read("in_top_left", top_left)
        .read("in_top_right", top_right)
        .read("in_bottom_left", bottom_left)
        .read("in_bottom_right", bottom_right)
        .write("out_display", display);
    return display;
}

}  // namespace farlight
