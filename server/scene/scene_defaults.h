// What a model without camera or light gets, so that any glTF file shows a picture.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

/// Sees all of `bounds` from the front, turned to the right and slightly from above. y is up.
CameraPose framing_camera(const Bounds& bounds);

/// Gives `scene` framing_camera() and says so in its notes.
void add_framing_camera(Scene& scene);

/// If there is no light of any kind, and anything that needs one: a dim background and a spherical
/// lamp, with a note.
void add_default_light(Scene& scene);

}  // namespace farlight
