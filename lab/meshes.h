// Meshes made by formula: what traversal tests and benchmarks shoot at.
#pragma once

#include "server/scene/scene.h"

#include <cstddef>

namespace farlight {

/// A closed sphere-like surface with bumps: `around` x `along` quads of two triangles (poles: one).
/// Counter-clockwise seen from outside, centered at `center`, radius about 1 in [0.8, 1.2].
Mesh bumpy_sphere(int around, int along, const glm::vec3& center = glm::vec3(0));

/// `count` random triangles of random size in [-1, 1]^3. Seeded.
Mesh triangle_soup(std::size_t count, unsigned seed);

/// A scene of one white diffuse object without light.
Scene scene_of(Mesh mesh);

/// A closed box of side 4 of one material, seen from inside.
Scene box_of(const Material& material);

/// The mesh inside a closed box of side 4 with a light at its ceiling: what rays of a path tracer
/// meet.
Scene room_with(Mesh mesh);

}  // namespace farlight
