// Scenes far from the origin of their coordinates: which point to count from instead, and how.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

/// The point from which a scene's coordinates are counted where they become single precision: zero
/// for a scene that lies about its origin, else a point on a grid near what its camera looks at.
///
/// The grid's step is a power of two, 8 to 16 times the distance of what is looked at or the
/// scene's radius, whichever is less. So a scene scaled by a power of two has its origin scaled,
/// one moved by whole steps has its origin moved, and their coordinates stay the same to the bit.
glm::dvec3 origin_of(const Scene& scene);

/// Counts shapes, lights and nodes from `origin` (in the coordinates of before), and notes it in
/// Scene::origin. Cameras stay as they are. In double precision.
void count_from(Scene& scene, const glm::dvec3& origin);

}  // namespace farlight
