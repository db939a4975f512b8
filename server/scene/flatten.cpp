// Every object's shape in world space.
#include "server/scene/flatten.h"

#include "shaders/shared/scene_layout.h"

#include <cmath>
#include <utility>

namespace farlight {
namespace {

class Flattener {
public:
    explicit Flattener(const Scene& scene) : scene_(scene) { }

    FlatScene run()
    {
        for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
            object_ = i;
            std::visit([this](const auto& shape) { add(shape); }, scene_.objects[i].shape);
        }
        return std::move(flat_);
    }

private:
    void add(const Sphere& sphere)
    {
        flat_.spheres.push_back({glm::vec3(sphere.center), static_cast<float>(sphere.radius),
            object_, add_light(light_of(sphere))});
    }

    void add(const Disk& disk)
    {
        flat_.disks.push_back({glm::vec3(disk.center), static_cast<float>(disk.radius),
            glm::vec3(glm::normalize(disk.normal)), object_, add_light(light_of(disk))});
    }

    void add(const Quad& quad)
    {
        const auto p0 = glm::vec3(quad.corner);
        const auto u = glm::vec3(quad.corner + quad.edge_u);
        const auto v = glm::vec3(quad.corner + quad.edge_v);
        const auto uv = glm::vec3(quad.corner + quad.edge_u + quad.edge_v);
        const std::uint32_t light = add_light(light_of_quad(p0, u - p0, v - p0));
        for (const FlatTriangle& half :
            {FlatTriangle{{p0, u, uv}, object_, light, 0}, {{p0, uv, v}, object_, light, 1}})
            if (is_usable(half))
                flat_.triangles.push_back(half);
    }

    void add(const MeshInstance& instance)
    {
        const Mesh& mesh = scene_.meshes[instance.mesh];
        const bool mirrored = glm::determinant(glm::dmat3(instance.world_from_object)) < 0;
        for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
            FlatTriangle triangle{{}, object_, 0, face};
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t corner = mesh.triangles[face][corner_of(k, mirrored)];
                triangle.vertices[static_cast<std::size_t>(k)] =
                    glm::vec3(instance.world_from_object * glm::dvec4(mesh.positions[corner], 1));
            }
            if (!is_usable(triangle))
                continue;
            const auto& [a, b, c] = triangle.vertices;
            Light light = light_of_triangle(a, b - a, c - a);
            light.face = face;
            light.mirrored = mirrored;
            triangle.light = add_light(light);
            flat_.triangles.push_back(triangle);
        }
    }

    /// Counts what is not.
    bool is_usable(const FlatTriangle& triangle)
    {
        const auto& [a, b, c] = triangle.vertices;
        const double area =
            glm::length(glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a)));
        const bool usable = area > 0 && std::isfinite(area);
        flat_.dropped_triangles += usable ? 0 : 1;
        return usable;
    }

    /// Index + 1 of the light, or 0 when this emits nothing worth choosing.
    std::uint32_t add_light(Light light)
    {
        const Object& object = scene_.objects[object_];
        if (!is_sampled(scene_, object) || !(light.area > 0))
            return 0;
        light.object = object_;
        flat_.lights.push_back(light);
        return static_cast<std::uint32_t>(flat_.lights.size());
    }

    const Scene& scene_;
    std::uint32_t object_ = 0;
    FlatScene flat_;
};

}  // namespace

FlatScene flatten(const Scene& scene)
{
    return Flattener(scene).run();
}

}  // namespace farlight
