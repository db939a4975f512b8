// Unrest at rest, and what happens after the light changes from one frame to the next: what the
// time and error of single frames do not show of a denoiser that remembers.
#pragma once

#include "client/accuracy/errors.h"

namespace farlight::client {

/// A change of the scene from one frame to the next.
struct LightStep {
    std::string what;  ///< "every light at a quarter"
    nlohmann::json patch;  ///< For Session::edit().
};

/// Dims every light that a Farlight scene names (lights, materials that emit, background,
/// environment map); a patch of null where the document names none.
LightStep dimming(const nlohmann::json& document);

struct ResponsePlan {
    int seeds = 3;
    int history = 32;  ///< Frames before the unrest is looked at.
    int still_frames = 32;  ///< Whose unrest is measured.
    int after = 24;  ///< Frames after the step.
    Settings settings;
};

double work_of_response(const SweepPoint& point, const ResponsePlan& plan);

/// {"flicker", "difference", "errors": relMSE of each frame from the step on, against
/// `after_step`, "lag"}. Without a step the last two are absent.
nlohmann::json measure_response(Rig& rig, const SweepPoint& point, const ResponsePlan& plan,
    const LightStep& step, Mask counts, const ReferencePicture* after_step);

}  // namespace farlight::client
