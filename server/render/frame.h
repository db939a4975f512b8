// One frame as a list of passes. Read frame.cpp first: it is the renderer at a glance.
#pragma once

#include "server/passes/frame_inputs.h"
#include "server/render/settings.h"

#include <optional>

namespace farlight {

/// What build_frame() needs to know beyond the settings.
struct FramePlan {
    RenderSettings settings;
    int mean_frames = 1;  ///< Frames in the running mean with this one.
    bool refine = false;
    float scene_radius = 1;  ///< [m], scales debug views.
    bool scatters = true;  ///< Something in the scene is lit and can show it.
    bool linear_output =
        false;  ///< The caller wants numbers (rgba32f), not display values (rgba8).
};

/// Effects that the frame's settings call for, whatever the scene is.
std::vector<ActiveEffect> effects_by_settings(const FramePlan& plan);

/// Declares the whole frame; returns the texture to read back, rgba8 or rgba32f.
TextureHandle build_frame(FrameGraph& graph, const FrameInputs& inputs, const FramePlan& plan);

}  // namespace farlight
