// Point, spot and directional lights.
#include "server/scene/scene_json_light.h"

#include "server/scene/scene_json_values.h"
#include "server/scene/spot_cone.h"

namespace farlight {

namespace {

using Json = nlohmann::json;

void read_cone(const Json& spot, const ScenePlace& place, PunctualLight& light)
{
    light.inner_cone = glm::radians(spot.value("inner_cone_degrees", 0.0));
    light.outer_cone = glm::radians(spot.value("outer_cone_degrees", 45.0));
    if (!(light.inner_cone < light.outer_cone))
        refuse(place,
            "an inner cone of " + Json(glm::degrees(light.inner_cone)).dump()
                + " degrees in an outer one of " + Json(glm::degrees(light.outer_cone)).dump(),
            "inner_cone_degrees less than outer_cone_degrees");
}

PunctualLight read_light(const Json& value, const ScenePlace& place)
{
    PunctualLight light;
    light.intensity = vec3(value["intensity"]);
    if (value.contains("point")) {
        light.position = vec3(value["point"]["position"]);
    } else if (value.contains("spot")) {
        light.kind = PunctualLight::Kind::kSpot;
        light.position = vec3(value["spot"]["position"]);
        light.direction = direction_or(value["spot"], "direction", light.direction, place / "spot");
        read_cone(value["spot"], place / "spot", light);
    } else {
        light.kind = PunctualLight::Kind::kDirectional;
        light.direction =
            direction_or(value["directional"], "direction", light.direction, place / "directional");
    }
    return light;
}

}  // namespace

void read_lights(const Json& document, const ScenePlace& root, SceneMotion& motion, Scene& scene)
{
    if (!document.contains("lights"))
        return;
    for (const auto& [name, value] : document["lights"].items()) {
        const ScenePlace place = root / "lights" / name;
        PunctualLight light = read_light(value, place);
        light.name = name;
        if (light.kind == PunctualLight::Kind::kSpot && clamp_cones(light))
            scene.notes.push_back("spot light " + Json(name).dump()
                + ": its cones made wide enough to have a soft edge");
        const Carrier carrier = motion.carrier_of({"light", name}, value, light.position, place);
        light.node = carrier.node;
        light.position -= carrier.origin;
        scene.lights.push_back(std::move(light));
    }
}

}  // namespace farlight
