// Lamps that move: what a denoiser that remembers makes of a light that is never where it was, and
// how long it shows the old place after the lamps have stopped.
#pragma once

#include "client/accuracy/response.h"

namespace farlight::client {

/// A motion of a scene's lamps that begins at time 0 and takes `frames` frames.
struct LightMotion {
    std::string what;  ///< "every lamp with a surface moves by about its own width"
    nlohmann::json patch;  ///< For Session::edit(); null where the document names no such lamp.
    int frames = 8;
};

/// Moves quads, disks and spheres that emit by about their own width, and point and spot lights a
/// quarter of the way to `middle`, by timeline events beside those that the scene has.
LightMotion motion_of_lamps(
    const nlohmann::json& document, const std::array<double, 3>& middle, int frames);

/// The truth of each moment: frame 0, before the motion, to the last of it.
using MovingReference = std::vector<ReferencePicture>;

/// Draws them, as draw_reference() does, in folders of `folder` that are made. The scene is the
/// patched one.
MovingReference draw_moving_reference(Rig& rig, const ReferencePlan& plan,
    const LightMotion& motion, const std::filesystem::path& folder, Progress& progress);

/// Removes what draw_moving_reference() keeps.
void remove_moving_reference(const std::filesystem::path& folder);

double work_of_motion(const SweepPoint& point, const ResponsePlan& plan, int frames);

/// {"flicker": unrest about the truth while the lamps move, "errors": relMSE of each frame of the
/// motion against its own moment and of `plan.after` frames at rest after it, "lag": of those at
/// rest}. The scene is the patched one.
nlohmann::json measure_motion(
    Rig& rig, const SweepPoint& point, const ResponsePlan& plan, const MovingReference& truth);

}  // namespace farlight::client
