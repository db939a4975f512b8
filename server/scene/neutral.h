// Taking out of a scene what makes no difference, so that it is neither detected, packed nor drawn.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

/// Leaves the scene looking the same, with every index as it was, and:
///   * materials of no object are plain, and use no texture
///   * textures whose texels are all equal are folded into the constant beside them; flat normal
///     maps, textures multiplied by zero and what an unlit material ignores are gone
///   * an alpha mode other than opaque can make a difference
///   * vertex colours that are all white are gone
///   * tracks that never change anything are folded into what they drive, or gone; what is then
///     switched off for good has no intensity
///   * morph targets whose weights never change are in the vertices, and gone
///   * a black or uniform environment map, a medium without cross section and a lens without
///     aperture are gone
/// Before packing and detection; a second call changes nothing.
void drop_neutral(Scene& scene);

}  // namespace farlight
