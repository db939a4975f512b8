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

/// Whether single precision loses something even so: a thing that is farther from what positions
/// are counted from than 2^16 of its radii. Such a scene is counted from near the camera of each
/// frame instead.
bool is_wide(const Scene& scene);

/// From where a frame of a wide scene is counted: the point next to its camera on a grid whose step
/// is a power of two, about a thousandth of the scene's radius. A function of the camera alone, so
/// that no picture depends on the ones before.
glm::dvec3 origin_near(const glm::dvec3& camera, double scene_radius);

/// Counts shapes, lights and nodes from `origin` (in the coordinates of before), and notes it in
/// Scene::origin. Cameras stay as they are. In double precision.
void count_from(Scene& scene, const glm::dvec3& origin);

}  // namespace farlight
