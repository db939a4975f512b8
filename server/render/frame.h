// One frame as a list of passes. Read frame.cpp first: it is the renderer at a glance.
#pragma once

#include "server/passes/accumulate.h"
#include "server/passes/frame_inputs.h"
#include "server/render/settings.h"

#include <optional>

namespace farlight {

/// What a frame tells of its error (server/render/error_schedule.h).
struct ErrorLooks {
    bool predicts = false;  ///< Sum up what samples say of the denoised picture's error.
    bool second_of_pair = false;  ///< The frame before began a pair; see predict.comp.
    bool measures = false;  ///< Sum up what is known of the mean's error and, against an older
                            ///< mean, of the denoised picture's.
    int measured_against = 0;  ///< Frames in the older mean; 0: there is none.
    Reference reference = Reference::kAbsent;
};

/// What build_frame() needs to know beyond the settings.
struct FramePlan {
    RenderSettings settings;
    int mean_frames = 1;  ///< Frames in the running mean with this one.
    std::uint32_t frame_index = 0;  ///< Frames since the cut.
    bool refine = false;
    ErrorLooks looks;
    bool keeps_flip = false;  ///< The FLIP map is the last one, if there is one.
    float scene_radius = 1;  ///< [m], scales debug views.
    glm::dvec3 origin{0};  ///< From where the device counts positions.
    bool scatters = true;  ///< Something in the scene is lit and can show it.
    bool linear_output =
        false;  ///< The caller wants numbers (rgba32f), not display values (rgba8).
};

/// Effects that the frame's settings call for, whatever the scene is.
std::vector<ActiveEffect> effects_by_settings(const FramePlan& plan);

/// Whether a filter stands between samples and picture.
bool is_denoised(const FramePlan& plan);

/// Whether a running mean of the raw pictures is kept, and how much of it the picture shows.
bool is_averaged(const FramePlan& plan);
double mean_weight(const FramePlan& plan);

/// Declares the whole frame; returns the texture to read back, rgba8 or rgba32f.
TextureHandle build_frame(FrameGraph& graph, const FrameInputs& inputs, const FramePlan& plan);

}  // namespace farlight
