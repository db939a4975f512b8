// A body is around a point as often as its surface winds around it.
//
// Sources: Jacobson et al. 2013, "Robust Inside-Outside Segmentation using Generalized Winding
// Numbers" (a surface with gaps winds by a fraction, which is rounded); van Oosterom and Strackee
// 1983, "The Solid Angle of a Plane Triangle".
#include "server/scene/insides.h"

#include "server/host_guard.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farlight {
namespace {

const HostGuard paths_start_in_what_is_around("paths_start_in_what_is_around");

bool has_inside(const Material& m)
{
    return !m.unlit && m.transmission > 0 && !m.thin_walled;
}

/// Half the solid angle of a triangle seen from the origin, negative from its front.
double half_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    return std::atan2(glm::dot(a, glm::cross(b, c)),
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

bool contains(const Bounds& bounds, const glm::dvec3& p)
{
    return glm::all(glm::lessThanEqual(bounds.lower, p))
        && glm::all(glm::lessThanEqual(p, bounds.upper));
}

}  // namespace

Insides::Insides(const Scene& scene)
{
    for (const Object& object : scene.objects) {
        if (!has_inside(scene.materials[object.material]))
            continue;
        Body& body = body_of(object.material, object.node);
        if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
            body.spheres.push_back(*sphere);
            body.bounds.extend(sphere->center - sphere->radius);
            body.bounds.extend(sphere->center + sphere->radius);
        } else if (const auto* quad = std::get_if<Quad>(&object.shape)) {
            const glm::dvec3 opposite = quad->corner + quad->edge_u + quad->edge_v;
            add_triangle(body, {quad->corner, quad->corner + quad->edge_u, opposite});
            add_triangle(body, {quad->corner, opposite, quad->corner + quad->edge_v});
        } else if (const auto* instance = std::get_if<MeshInstance>(&object.shape)) {
            const Mesh& mesh = scene.meshes[instance->mesh];
            if (instance->skin == kNone && mesh.morph_targets.empty())
                add_mesh(body, mesh, instance->world_from_object);
        }
    }
    if (bodies_.empty())
        return;
    for (const Material& material : scene.materials) {
        priorities_.push_back(material.priority);
        absorptions_.push_back(material.absorption);
    }
}

Insides::Body& Insides::body_of(std::uint32_t material, std::uint32_t node)
{
    const auto found = std::find_if(bodies_.begin(), bodies_.end(),
        [&](const Body& body) { return body.material == material && body.node == node; });
    if (found != bodies_.end())
        return *found;
    bodies_.emplace_back();
    bodies_.back().material = material;
    bodies_.back().node = node;
    return bodies_.back();
}

void Insides::add_triangle(Body& body, const std::array<glm::dvec3, 3>& corners)
{
    body.triangles.push_back({glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2])});
    for (const glm::dvec3& corner : corners)
        body.bounds.extend(corner);
}

void Insides::add_mesh(Body& body, const Mesh& mesh, const glm::dmat4& place)
{
    // Mirrored, outside stays outside.
    const bool mirrored = glm::determinant(glm::dmat3(place)) < 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const auto corner = [&](std::uint32_t i) {
            return glm::dvec3(place * glm::dvec4(mesh.positions[i], 1));
        };
        add_triangle(
            body, {corner(t.x), corner(mirrored ? t.z : t.y), corner(mirrored ? t.y : t.z)});
    }
}

int Insides::times_around(const Body& body, const glm::dvec3& point)
{
    if (!contains(body.bounds, point))
        return 0;
    double turns = 0;
    for (const Sphere& sphere : body.spheres)
        turns += glm::length(point - sphere.center) < sphere.radius ? 1 : 0;
    double half_angles = 0;
    for (const auto& [a, b, c] : body.triangles)
        half_angles +=
            half_solid_angle(glm::dvec3(a) - point, glm::dvec3(b) - point, glm::dvec3(c) - point);
    turns += half_angles / (2 * std::numbers::pi);
    // A lone surface never winds by more than a half.
    return turns > 0.5 + 1e-6 ? static_cast<int>(std::lround(turns)) : 0;
}

Insides::Filling Insides::at(
    const glm::dvec3& point, std::span<const glm::dmat4> world_from_node) const
{
    std::vector<Around> around;
    for (const Body& body : bodies_) {
        glm::dvec3 local = point;
        double scale = 1;
        if (body.node != kNone) {
            const glm::dmat4& place = world_from_node[body.node];
            const double volume = std::abs(glm::determinant(glm::dmat3(place)));
            if (!(volume > 0))
                continue;
            local = glm::dvec3(glm::inverse(place) * glm::dvec4(point, 1));
            scale = std::cbrt(volume);
        }
        const int times = std::min(times_around(body, local), 4);
        around.insert(around.end(), static_cast<std::size_t>(times),
            {body.material, scale * body.bounds.radius()});
    }
    return filling_of(std::move(around));
}

Insides::Filling Insides::filling_of(std::vector<Around> around) const
{
    Filling filling;
    if (!paths_start_in_what_is_around)
        return filling;
    std::stable_sort(around.begin(), around.end(),
        [](const Around& a, const Around& b) { return a.size > b.size; });
    const std::size_t first = around.size() > 4 ? around.size() - 4 : 0;
    int highest = 0;
    for (std::size_t i = first; i < around.size(); ++i) {
        const std::uint32_t material = around[i].material;
        filling.entered[static_cast<glm::length_t>(i - first)] = material + 1;
        if (i == first || priorities_[material] >= highest) {
            highest = priorities_[material];
            filling.absorption = absorptions_[material];
        }
    }
    return filling;
}

}  // namespace farlight
