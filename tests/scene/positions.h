// Where the vertices of a loaded scene are.
#pragma once

#include "server/scene/scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace farlight {

/// Of vertex `index` of the mesh that object number `object` places.
inline glm::dvec3 world_position(const Scene& scene, std::size_t object, std::size_t index)
{
    const auto& instance = std::get<MeshInstance>(scene.objects.at(object).shape);
    const glm::vec3 local = scene.meshes.at(instance.mesh).positions.at(index);
    return instance.world_from_object * glm::dvec4(local, 1);
}

inline void expect_near(
    const glm::dvec3& actual, const glm::dvec3& expected, double tolerance = 1e-12)
{
    EXPECT_LE(glm::length(actual - expected), tolerance)
        << actual.x << ' ' << actual.y << ' ' << actual.z;
}

}  // namespace farlight
