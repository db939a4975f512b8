// Shapes as lights, and their power, in double precision.
#include "server/scene/lights.h"

#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farlight {

using std::numbers::pi;

Light light_of(const Sphere& sphere)
{
    Light light{.kind = LIGHT_SPHERE, .p0 = glm::vec3(sphere.center)};
    light.edge_u.x = static_cast<float>(sphere.radius);
    light.area = static_cast<float>(4 * pi * sphere.radius * sphere.radius);
    return light;
}

Light light_of(const Disk& disk)
{
    Light light{.kind = LIGHT_DISK, .p0 = glm::vec3(disk.center)};
    light.edge_u.x = static_cast<float>(disk.radius);
    light.edge_v = glm::vec3(disk.normal);
    light.area = static_cast<float>(pi * disk.radius * disk.radius);
    return light;
}

Light light_of_quad(const glm::vec3& p0, const glm::vec3& edge_u, const glm::vec3& edge_v)
{
    Light light{.kind = LIGHT_QUAD, .p0 = p0, .edge_u = edge_u, .edge_v = edge_v};
    light.area = glm::length(glm::cross(edge_u, edge_v));
    return light;
}

Light light_of_triangle(const glm::vec3& p0, const glm::vec3& edge_u, const glm::vec3& edge_v)
{
    Light light = light_of_quad(p0, edge_u, edge_v);
    light.kind = LIGHT_TRIANGLE;
    light.area *= 0.5F;
    return light;
}

Light light_of(const PunctualLight& punctual, const glm::dmat4& world_from_node)
{
    static constexpr std::uint32_t kKinds[] = {LIGHT_POINT, LIGHT_SPOT, LIGHT_DIRECTIONAL};
    Light light{.kind = kKinds[static_cast<std::size_t>(punctual.kind)]};
    light.p0 = glm::vec3(world_from_node * glm::dvec4(punctual.position, 1));
    const glm::dvec3 way = glm::dmat3(world_from_node) * punctual.direction;
    const bool directed = glm::dot(way, way) > 0;
    light.edge_v = glm::vec3(directed ? glm::normalize(way) : punctual.direction);
    if (directed || punctual.kind == PunctualLight::Kind::kPoint) {
        light.radiance = punctual.intensity;
        light.mean_luminance = luminance(punctual.intensity);
    }
    if (punctual.kind == PunctualLight::Kind::kSpot) {
        const double inner = std::cos(punctual.inner_cone);
        const double outer = std::cos(punctual.outer_cone);
        light.edge_u.x = static_cast<float>(1 / (inner - outer));
        light.edge_u.y = static_cast<float>(-outer / (inner - outer));
    }
    return light;
}

double luminance(const glm::dvec3& rgb)
{
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

double light_power(const Light& light, double scene_radius)
{
    switch (light.kind) {
    case LIGHT_POINT: return 4 * pi * light.mean_luminance;
    case LIGHT_SPOT: {
        // The falloff ((c - outer) / (inner - outer))^2, integrated over the cosine c.
        const double width = 1 / static_cast<double>(light.edge_u.x);
        const double inner = width * (1 - static_cast<double>(light.edge_u.y));
        return 2 * pi * (width / 3 + std::max(1 - inner, 0.0)) * light.mean_luminance;
    }
    case LIGHT_DIRECTIONAL:
    case LIGHT_ENVIRONMENT: return pi * scene_radius * scene_radius * light.mean_luminance;
    default: return pi * light.mean_luminance * light.area * (light.emits_both_sides ? 2 : 1);
    }
}

bool is_sampled(const Scene& scene, const Object& object)
{
    const Material& material = scene.materials[object.material];
    if (!(luminance(material.emission) > 0))
        return false;
    const bool holes = material.alpha_mode != AlphaMode::kOpaque;
    const bool textured =
        material.emission_texture.used() || (holes && material.albedo_texture.used());
    if (std::holds_alternative<Sphere>(object.shape) || std::holds_alternative<Disk>(object.shape))
        return !textured;
    const auto* instance = std::get_if<MeshInstance>(&object.shape);
    return instance == nullptr || !holes || scene.meshes[instance->mesh].colors.empty();
}

}  // namespace farlight
