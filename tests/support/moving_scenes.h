// Scenes with things that move.
#pragma once

#include "server/scene/scene.h"

#include <functional>
#include <vector>

namespace farlight {

/// Hangs every object on a node of its own that stands, from time 1 s on, where `world_from_node`
/// says. With `moving` it comes there from a little aside, where it was at time 0.
void hang_on_nodes(
    Scene& scene, const std::function<glm::dmat4(std::size_t)>& world_from_node, bool moving);

/// A bumpy bar around the y axis from 0 to 2 with two joints: the lower rests, the upper turns
/// about z through (0, 1, 0), by one radian from time 0 to time 1 s.
Scene bending_bar(int around, int along);

/// A bumpy sphere whose morph target stretches it along x and y; its weight goes from 0 to 1 in one
/// second. Carried by a node that moves.
Scene swelling_sphere(int around, int along);

struct NamedScene {
    const char* what;
    Scene scene;
};

constexpr float kRestingWeight = 0.6F;

/// Meshes with morph targets or a skin whose shape never changes, each on a node that moves: a
/// morph at kRestingWeight, one under a track that never changes, a skin (which its node does not
/// carry).
std::vector<NamedScene> resting_shapes();

}  // namespace farlight
