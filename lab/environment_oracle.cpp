// See the header.
#include "lab/environment_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace farlight::lab {
namespace {

using std::numbers::pi;

constexpr int kParts = 48;  // of a texel, along each side

glm::dvec3 way_of_place(double u, double v)
{
    const double theta = pi * v;
    const double phi = 2 * pi * (u - 0.5);
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

double texel_of(const EnvironmentMap& map, std::int64_t x, std::int64_t y)
{
    const auto width = static_cast<std::int64_t>(map.width);
    const std::int64_t row = std::clamp<std::int64_t>(y, 0, map.height - 1);
    return map.texels[static_cast<std::size_t>(row * width + (x % width + width) % width)].x;
}

}  // namespace

std::shared_ptr<EnvironmentMap> map_of(std::uint32_t width, std::uint32_t height,
    const std::function<double(const glm::dvec3&)>& radiance)
{
    auto map = std::make_shared<EnvironmentMap>(EnvironmentMap{"map", width, height, {}});
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            map->texels.emplace_back(
                static_cast<float>(radiance(way_of_place((x + 0.5) / width, (y + 0.5) / height))));
    return map;
}

std::shared_ptr<EnvironmentMap> random_map(std::uint32_t width, std::uint32_t height)
{
    std::mt19937 random(44);
    std::uniform_real_distribution<double> uniform(0, 1);
    return map_of(width, height, [&](const glm::dvec3&) { return uniform(random); });
}

double radiance_at(const EnvironmentMap& map, double u, double v)
{
    const double x = u * map.width - 0.5;
    const double y = v * map.height - 0.5;
    const auto left = static_cast<std::int64_t>(std::floor(x));
    const auto upper = static_cast<std::int64_t>(std::floor(y));
    const double fx = x - std::floor(x);
    const double fy = y - std::floor(y);
    return (1 - fy) * ((1 - fx) * texel_of(map, left, upper) + fx * texel_of(map, left + 1, upper))
        + fy
        * ((1 - fx) * texel_of(map, left, upper + 1) + fx * texel_of(map, left + 1, upper + 1));
}

double radiance_along(const EnvironmentMap& map, const glm::dvec3& way)
{
    return radiance_at(map, 0.5 + std::atan2(way.x, -way.z) / (2 * pi),
        std::atan2(std::hypot(way.x, way.z), way.y) / pi);
}

double integral_of(const EnvironmentMap& map)
{
    double sum = 0;
    for (std::uint32_t y = 0; y < map.height * kParts; ++y) {
        const double v = (y + 0.5) / (map.height * kParts);
        const double ring = 2 * pi * std::sin(pi * v) * pi / (map.height * kParts);
        for (std::uint32_t x = 0; x < map.width * kParts; ++x)
            sum +=
                ring / (map.width * kParts) * radiance_at(map, (x + 0.5) / (map.width * kParts), v);
    }
    return sum;
}

std::vector<glm::vec4> ways_to_ends()
{
    std::vector<glm::vec4> ways;
    for (const float y : {1.0F, -1.0F, 0.0F, 0.3F})
        for (const float aside : {0.0F, 1e-44F, 1e-30F, 1e-12F, 1e-4F, 1.0F})
            for (const float x : {-1.0F, -0.0F, 0.0F, 1.0F})
                for (const float z : {-1.0F, -0.0F, 0.0F, 1.0F})
                    ways.emplace_back(x * aside, y, z * aside, 0);
    for (const float beside : {0.0F, -0.0F, 1e-44F, -1e-44F, 1e-30F, -1e-30F, 1e-7F, -1e-7F})
        for (const float y : {-0.9F, 0.0F, 0.5F})
            ways.emplace_back(beside, y, 1.0F, 0);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (int i = 0; i < 10'000; ++i)
        ways.emplace_back(uniform(random), uniform(random), uniform(random), 0);
    std::erase_if(
        ways, [](const glm::vec4& way) { return !(glm::length(glm::dvec3(way)) > 1e-3); });
    for (glm::vec4& way : ways)
        way = glm::vec4(glm::vec3(glm::normalize(glm::dvec3(way))), 0);
    return ways;
}

}  // namespace farlight::lab
