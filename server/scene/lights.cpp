// Power and the alias table, in double precision.
#include "server/scene/lights.h"

#include "shaders/shared/scene_layout.h"

#include <cassert>
#include <numbers>

namespace farlight {

Light light_of(const Sphere& sphere)
{
    Light light{.kind = LIGHT_SPHERE, .p0 = glm::vec3(sphere.center)};
    light.edge_u.x = static_cast<float>(sphere.radius);
    light.area = static_cast<float>(4 * std::numbers::pi * sphere.radius * sphere.radius);
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

double luminance(const glm::dvec3& rgb)
{
    return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z;
}

double light_power(const Light& light, const Material& material)
{
    const double sides = material.emits_both_sides ? 2 : 1;
    return std::numbers::pi * luminance(material.emission) * light.area * sides;
}

void fill_alias_table(std::span<Light> lights)
{
    double total = 0;
    for (const Light& light : lights)
        total += light.power;

    std::vector<double> scaled(lights.size());
    std::vector<std::uint32_t> small;
    std::vector<std::uint32_t> large;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        assert(lights[i].power > 0);
        lights[i].pmf = static_cast<float>(lights[i].power / total);
        scaled[i] = lights[i].power / total * static_cast<double>(lights.size());
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t s = small.back();
        const std::uint32_t l = large.back();
        small.pop_back();
        lights[s].alias_threshold = static_cast<float>(scaled[s]);
        lights[s].alias = l;
        scaled[l] -= 1 - scaled[s];
        if (scaled[l] < 1) {
            large.pop_back();
            small.push_back(l);
        }
    }
    for (const auto& rest : {small, large})
        for (const std::uint32_t i : rest) {
            lights[i].alias_threshold = 1;
            lights[i].alias = i;
        }
}

Texels pack_lights(std::span<const Light> lights)
{
    Texels texels;
    for (const Light& light : lights) {
        texels.emplace_back(light.kind | (light.emits_both_sides ? LIGHT_EMITS_BOTH_SIDES : 0), 0,
            bits(light.pmf), bits(light.area));
        texels.push_back(texel(light.p0, bits(light.alias_threshold)));
        texels.push_back(texel(light.edge_u, light.alias));
        texels.push_back(texel(light.edge_v, 0));
        texels.push_back(texel(light.radiance, 0));
    }
    return texels;
}

}  // namespace farlight
