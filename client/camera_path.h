// Camera paths: poses by frame, from keyframes or by turning about the scene's middle.
#pragma once

#include "client/json_input.h"
#include "protocol/messages.h"

#include <vector>

namespace farlight::client {

using protocol::Keyframe;
using protocol::Pose;

/// `pose` turned rigidly by `degrees` about the vertical (y) axis through `center`; positive is
/// counter-clockwise seen from above.
Pose orbit(const Pose& pose, const std::array<double, 3>& center, double degrees);

/// Degrees turned by frame `frame` of `frames` when the whole turn is `total`: 0 at the first,
/// `total` at the last.
double orbit_angle(double total, int frame, int frames);

/// The pose at `frame`: linear between keyframes, held before the first and after the last.
/// Asserts at least one keyframe, frames strictly increasing.
Pose pose_at(const std::vector<Keyframe>& path, double frame);

/// An array of keyframes, fields as in PROTOCOL.md. Throws InputError.
std::vector<Keyframe> read_keyframes(const JsonInput& input);

/// The middle of the scene's bounds; the origin of an empty scene.
std::array<double, 3> middle_of(const protocol::SceneSummary& scene);

}  // namespace farlight::client
