// World-space bounds.
#include "server/scene/scene.h"

#include "server/scene/deform.h"

#include <cmath>
#include <limits>

namespace farlight {
namespace {

/// Where things stand at time 0.
struct Rest {
    const Scene& scene;
    std::vector<glm::dmat4> world_from_node = pose_nodes(scene.animation, 0);
};

void extend_box(
    Bounds& bounds, const glm::dmat4& m, const glm::dvec3& lower, const glm::dvec3& upper)
{
    for (unsigned corner = 0; corner < 8; ++corner)
        bounds.extend(glm::dvec3(m
            * glm::dvec4((corner & 1U) != 0 ? upper.x : lower.x,
                (corner & 2U) != 0 ? upper.y : lower.y, (corner & 4U) != 0 ? upper.z : lower.z,
                1)));
}

void extend(Bounds& bounds, const Rest& /*rest*/, const Sphere& sphere, const glm::dmat4& m)
{
    // An ellipsoid reaches radius * |row of m| along an axis.
    const glm::dmat3 rows = glm::transpose(glm::dmat3(m));
    const glm::dvec3 center(m * glm::dvec4(sphere.center, 1));
    const glm::dvec3 reach = sphere.radius
        * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    bounds.extend(center - reach);
    bounds.extend(center + reach);
}

void extend(Bounds& bounds, const Rest& /*rest*/, const Quad& quad, const glm::dmat4& m)
{
    for (const glm::dvec3& p : {quad.corner, quad.corner + quad.edge_u, quad.corner + quad.edge_v,
             quad.corner + quad.edge_u + quad.edge_v})
        bounds.extend(glm::dvec3(m * glm::dvec4(p, 1)));
}

void extend(Bounds& bounds, const Rest& /*rest*/, const Disk& disk, const glm::dmat4& m)
{
    // A disk reaches radius * sin(angle to its normal) along an axis.
    const glm::dvec3 reach =
        disk.radius * glm::sqrt(glm::max(glm::dvec3(0), 1.0 - disk.normal * disk.normal));
    extend_box(bounds, m, disk.center - reach, disk.center + reach);
}

void extend(Bounds& bounds, const Rest& rest, const MeshInstance& instance, const glm::dmat4& m)
{
    for (const glm::vec3& position : rest.scene.meshes[instance.mesh].positions)
        bounds.extend(glm::dvec3(m * instance.world_from_object * glm::dvec4(position, 1)));
}

/// A vertex that overflowed on its joints' way is everywhere: a NaN would pass every minimum.
void extend_by_posed(Bounds& bounds, const glm::vec3& p)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
        return bounds.extend(glm::dvec3(p));
    bounds.extend(glm::dvec3(-kInfinity));
    bounds.extend(glm::dvec3(kInfinity));
}

}  // namespace

std::vector<Bounds> object_bounds(const Scene& scene)
{
    const Rest rest{scene};
    std::vector<Bounds> all(scene.objects.size());
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        if (has_pose(scene, object)) {
            for (const glm::vec3& p : pose_object(scene, i, 0, rest.world_from_node).positions)
                extend_by_posed(all[i], p);
            continue;
        }
        const glm::dmat4 world = carried(object.node, rest.world_from_node, glm::dmat4(1));
        std::visit([&](const auto& shape) { extend(all[i], rest, shape, world); }, object.shape);
    }
    return all;
}

Bounds scene_bounds(const Scene& scene)
{
    Bounds bounds;
    const std::vector<Bounds> objects = object_bounds(scene);
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (scene.objects[i].framed)
            bounds.extend(objects[i]);
    return bounds;
}

}  // namespace farlight
