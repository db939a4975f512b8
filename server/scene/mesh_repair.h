// What is done to every mesh from a file so that the rest may rely on it.
#pragma once

#include "server/scene/scene.h"

#include <cstddef>

namespace farlight {

/// The largest coordinate that is taken: a camera that frames objects out to here still stands
/// within the 1e12 of the protocol.
inline constexpr double kLargestCoordinate = 1e11;

/// Finite, and within kLargestCoordinate on each axis.
bool is_bounded(const glm::vec3& p);

struct MeshRepairs {
    std::size_t zero_area_triangles = 0;  ///< Dropped.
    std::size_t astray_triangles = 0;  ///< Dropped: a corner is no position.
    std::size_t unbounded_triangles = 0;  ///< Dropped: a corner is not finite or too far out.
    std::size_t replaced_normals = 0;  ///< Not finite or zero; now the mean of the faces around.
    std::size_t dropped_tangents = 0;  ///< Not finite or zero.
    std::size_t replaced_uvs = 0;  ///< Not finite; now 0.
    std::size_t changed_colors = 0;  ///< Now in [0, 1].
    std::size_t changed_weights = 0;  ///< Vertices whose joints' weights had no sum: now all first.
    std::size_t vertices_of_fewer_joints = 0;  ///< Which more than four joints would move.
    std::size_t unread_morph_attributes = 0;  ///< Other than positions and normals.
    std::size_t dropped_displacements = 0;  ///< Of morph targets, not finite or too far; now 0.

    MeshRepairs& operator+=(const MeshRepairs& other);
    /// One sentence a kind of repair that was made, for Scene::notes.
    std::vector<std::string> notes() const;
};

/// Drops triangles that have no area or no finite corner or a corner that is no position, then
/// vertices that no triangle needs any more; brings normals and tangents to unit length, the rest
/// to finite numbers. The mesh may come out empty. Asserts that there are as many normals as
/// positions, or none.
MeshRepairs repair_mesh(Mesh& mesh);

/// A cube from -0.5 to 0.5 on each axis, faces flat and outward.
Mesh unit_cube();

}  // namespace farlight
