// World-space bounds.
#include "server/scene/scene.h"

namespace farlight {

namespace {

Bounds shape_bounds(const Scene& /*scene*/, const Sphere& sphere)
{
    Bounds bounds;
    bounds.extend(sphere.center - sphere.radius);
    bounds.extend(sphere.center + sphere.radius);
    return bounds;
}

Bounds shape_bounds(const Scene& /*scene*/, const Quad& quad)
{
    Bounds bounds;
    bounds.extend(quad.corner);
    bounds.extend(quad.corner + quad.edge_u);
    bounds.extend(quad.corner + quad.edge_v);
    bounds.extend(quad.corner + quad.edge_u + quad.edge_v);
    return bounds;
}

Bounds shape_bounds(const Scene& /*scene*/, const Disk& disk)
{
    // A disc reaches radius * sin(angle to its normal) along an axis.
    const glm::dvec3 reach =
        disk.radius * glm::sqrt(glm::max(glm::dvec3(0), 1.0 - disk.normal * disk.normal));
    Bounds bounds;
    bounds.extend(disk.center - reach);
    bounds.extend(disk.center + reach);
    return bounds;
}

Bounds shape_bounds(const Scene& scene, const MeshInstance& instance)
{
    Bounds bounds;
    for (const glm::vec3& position : scene.meshes[instance.mesh].positions)
        bounds.extend(glm::dvec3(instance.world_from_object * glm::dvec4(position, 1)));
    return bounds;
}

}  // namespace

Bounds scene_bounds(const Scene& scene)
{
    Bounds bounds;
    for (const Object& object : scene.objects)
        if (object.framed)
            bounds.extend(std::visit(
                [&](const auto& shape) { return shape_bounds(scene, shape); }, object.shape));
    return bounds;
}

}  // namespace farlight
