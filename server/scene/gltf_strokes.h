// Points and lines have no surface: small octahedra and thin prisms stand for them.
#pragma once

#include "server/scene/scene.h"

namespace farlight {

/// Whether a glTF primitive mode is one of points or lines.
inline constexpr bool is_strokes(int mode)
{
    return mode >= 0 && mode <= 3;
}

/// Triangles of the solids that `corners` of a primitive of points or lines become, at most.
std::uint64_t triangles_of_strokes(std::uint64_t corners, int mode);

/// `vertices` without triangles and what connects them -> the solids, each with its vertices'
/// attributes but flat. They are as thick as 1/200 of the whole. Asserts is_strokes(mode) and
/// corners within the vertices.
Mesh strokes_as_solids(const Mesh& vertices, const std::vector<std::uint32_t>& corners, int mode);

}  // namespace farlight
