// A candela is read as one W/sr, a lux as one W/m^2. Light does not end at a `range`.
#include "server/scene/gltf_light.h"

#include "server/scene/spot_cone.h"

#include <numbers>

namespace farlight {

namespace {

using Json = nlohmann::json;

constexpr double kBrightest = 1e18;  // as for emission: its square is still a finite float

glm::vec3 intensity_of(const Json& light, std::size_t& changed)
{
    glm::dvec3 color(light.value("intensity", 1.0));
    if (light.contains("color"))
        for (int i = 0; i < 3; ++i)
            color[i] *= light["color"][static_cast<std::size_t>(i)].get<double>();
    const glm::dvec3 inside = glm::clamp(color, 0.0, kBrightest);
    changed += inside == color ? 0 : 1;
    return inside;
}

void read_cone(const Json& light, PunctualLight& read, std::size_t& changed)
{
    const Json spot = light.value("spot", Json::object());
    read.inner_cone = spot.value("innerConeAngle", 0.0);
    read.outer_cone = spot.value("outerConeAngle", std::numbers::pi / 4);
    changed += clamp_cones(read) ? 1 : 0;
}

}  // namespace

PunctualLight read_gltf_light(const GltfContainer& gltf, const Json& index, GltfLightCounts& counts)
{
    const Json& light = gltf_extension(gltf.document, "KHR_lights_punctual")
                            ->at("lights")[index.get<std::size_t>()];
    PunctualLight read;
    read.name = light.value("name", "");
    std::size_t changed = 0;
    read.intensity = intensity_of(light, changed);
    const auto type = light["type"].get<std::string>();
    read.kind = type == "point" ? PunctualLight::Kind::kPoint
        : type == "spot"        ? PunctualLight::Kind::kSpot
                                : PunctualLight::Kind::kDirectional;
    if (read.kind == PunctualLight::Kind::kSpot)
        read_cone(light, read, changed);
    counts.clamped += changed;
    counts.with_range += light.contains("range") ? 1 : 0;
    return read;
}

bool place_light(PunctualLight& light, const glm::dmat4& to_from)
{
    light.position = to_from * glm::dvec4(light.position, 1);
    light.direction = glm::dmat3(to_from) * light.direction;
    const double length = glm::length(light.direction);
    light.direction /= length;
    return length > 0 || light.kind == PunctualLight::Kind::kPoint;
}

}  // namespace farlight
