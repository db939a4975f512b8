// Scenes of many effects at once, put together by chance: for what no row of effect_pairs() shows,
// that effects which are right one by one are right together.
#pragma once

#include "server/scene/scene.h"

#include <random>
#include <string>

namespace farlight {

/// Some of the changes of effect_pairs(), one after the other, and things that deform, rest in a
/// pose or spin. `what` becomes the names of what it is made from.
Scene random_scene(std::mt19937& random, std::string& what);

}  // namespace farlight
