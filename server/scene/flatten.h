// Objects in pieces: the triangles, spheres and disks they consist of, and which of them emit.
#pragma once

#include "server/scene/lights.h"
#include "server/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace farlight {

/// A triangle before a tree has put it in order. What else its corners carry stays in the mesh.
struct FlatTriangle {
    std::array<glm::vec3, 3> vertices;
    std::uint32_t object = 0;
    std::uint32_t light = 0;  ///< Index + 1, 0: none.
    std::uint32_t face = 0;  ///< Of the mesh; of a quad: 0 or 1.
};

struct FlatSphere {
    glm::vec3 center;
    float radius;
    std::uint32_t object;
    std::uint32_t light = 0;
};

struct FlatDisk {
    glm::vec3 center;
    float radius;
    glm::vec3 normal;
    std::uint32_t object;
    std::uint32_t light = 0;
};

struct FlatScene {
    std::vector<FlatTriangle> triangles;
    std::vector<FlatSphere> spheres;
    std::vector<FlatDisk> disks;
    std::vector<Light> lights;  ///< Their shapes.
    std::size_t dropped_triangles = 0;  ///< Zero area or not finite once in world space.
};

/// Which corner of a mesh's face is vertex `k` of its triangle: a mirroring transform turns the
/// winding round, so two are swapped for outside to stay outside.
constexpr int corner_of(int k, bool mirrored)
{
    return mirrored && k > 0 ? 3 - k : k;
}

FlatScene flatten(const Scene& scene);

}  // namespace farlight
