// What a transform does to the things an instance is made of.
#pragma once

#include "server/scene/bvh.h"
#include "server/scene/lights.h"

#include <glm/glm.hpp>
#include <span>

namespace farlight {

/// Rotation, mirror and one scale for all directions, up to rounding: takes spheres to spheres.
bool is_similarity(const glm::dmat3& m);

/// Cube root of the volume's scale; a similarity's scale.
double scale_of(const glm::dmat4& m);

/// Whether a ray can be taken into the space that `m` comes from.
bool is_invertible(const glm::dmat4& m);

/// Three texels: the rows of an affine matrix.
void pack_rows(const glm::dmat4& m, std::span<glm::uvec4> texels);

/// Of what `m` makes of all that lies in `bounds`, and what rounding in the shader adds to it.
PrimitiveBounds transformed(const PrimitiveBounds& bounds, const glm::dmat4& m);

/// The light moved; a sphere or disk that becomes none gets no area, and is then never chosen.
Light transformed(const Light& shape, const glm::dmat4& m);

}  // namespace farlight
