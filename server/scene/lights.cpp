// Power and the alias table, in double precision.
#include "server/scene/lights.h"

#include <cassert>
#include <numbers>

namespace farlight {

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

}  // namespace farlight
