// Changes to which vertices a mesh has, for all its lists alike.
#pragma once

#include "server/scene/scene.h"

#include <functional>

namespace farlight {

/// Vertex i becomes what vertex from[i] was. Triangles keep their numbers.
void gather_vertices(Mesh& mesh, const std::vector<std::uint32_t>& from);

/// Drops vertices that no triangle has, and renumbers the rest in their order.
void drop_unused_vertices(Mesh& mesh);

/// Doubles each vertex that triangles of both kinds have, so that none does.
void split_vertices(Mesh& mesh, const std::function<bool(std::size_t triangle)>& is_second_kind);

}  // namespace farlight
