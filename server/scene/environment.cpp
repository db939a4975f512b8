// Weights of texels, and their alias table.
#include "server/scene/environment.h"

#include "server/scene/alias_table.h"
#include "server/scene/lights.h"
#include "shaders/shared/scene_layout.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <numbers>

namespace farlight {
namespace {

using std::numbers::pi;

/// Solid angle of a texel of row `row`: between two latitudes, over 2 pi / width of longitude.
double solid_angle(const EnvironmentMap& map, std::uint32_t row)
{
    const auto cosine = [&](double edge) { return std::cos(pi * edge / map.height); };
    return 2 * pi / map.width * (cosine(row) - cosine(row + 1.0));
}

/// Mean over the texel of what bilinear interpolation makes of the map: along each axis the texel
/// counts 6/8, its neighbours 1/8 each. The left edge continues at the right, a pole repeats.
glm::dvec3 mean_over_texel(const EnvironmentMap& map, std::uint32_t x, std::uint32_t y)
{
    static constexpr double kWeights[] = {0.125, 0.75, 0.125};
    glm::dvec3 sum(0);
    for (std::uint32_t j = 0; j < 3; ++j) {
        const std::uint32_t row = std::clamp(y + j, 1U, map.height) - 1;
        for (std::uint32_t i = 0; i < 3; ++i) {
            const std::uint32_t column = (x + i + map.width - 1) % map.width;
            sum += kWeights[i] * kWeights[j]
                * glm::dvec3(map.texels[std::size_t{row} * map.width + column]);
        }
    }
    return sum;
}

}  // namespace

PackedEnvironment pack_environment(const EnvironmentMap& map, const glm::mat3& map_from_world)
{
    assert(map.width > 0 && map.height > 0);
    assert(map.texels.size() == std::size_t{map.width} * map.height);
    PackedEnvironment packed;
    packed.texels.emplace_back(map.width, map.height, 0, 0);
    for (int row = 0; row < 3; ++row)
        packed.texels.push_back(texel(glm::row(map_from_world, row), 0));

    std::vector<double> weights;
    double total = 0;
    for (std::uint32_t y = 0; y < map.height; ++y) {
        const double omega = solid_angle(map, y);
        for (std::uint32_t x = 0; x < map.width; ++x) {
            const glm::dvec3 mean = mean_over_texel(map, x, y);
            weights.push_back(luminance(mean) * omega);
            total += weights.back();
            packed.mean_radiance += mean * omega / (4 * pi);
        }
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double omega = solid_angle(map, static_cast<std::uint32_t>(i / map.width));
        const double density = total > 0 ? weights[i] / total / omega : 0;
        packed.texels.push_back(texel(map.texels[i], bits(static_cast<float>(density))));
    }
    const std::vector<AliasSlot> slots = alias_table(weights);
    for (std::size_t i = 0; i < slots.size(); i += 2) {
        const AliasSlot second = i + 1 < slots.size() ? slots[i + 1] : AliasSlot{};
        packed.texels.emplace_back(
            bits(slots[i].threshold), slots[i].alias, bits(second.threshold), second.alias);
    }
    return packed;
}

}  // namespace farlight
