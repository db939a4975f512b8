// Vectors and transforms of a Farlight scene document.
#include "server/scene/scene_json_values.h"

#include <glm/gtc/matrix_transform.hpp>

namespace farlight {

using Json = nlohmann::json;

glm::dvec3 vec3(const Json& value)
{
    return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

glm::dvec3 vec3_or(const Json& object, const char* key, const glm::dvec3& fallback)
{
    const auto found = object.find(key);
    return found == object.end() ? fallback : vec3(*found);
}

glm::dmat4 rotation(const Json& object)
{
    const glm::dvec3 angles = glm::radians(vec3_or(object, "rotation_degrees", glm::dvec3(0)));
    const glm::dmat4 about_x = glm::rotate(glm::dmat4(1), angles.x, {1, 0, 0});
    const glm::dmat4 about_y = glm::rotate(glm::dmat4(1), angles.y, {0, 1, 0});
    const glm::dmat4 about_z = glm::rotate(glm::dmat4(1), angles.z, {0, 0, 1});
    return about_z * about_y * about_x;
}

glm::dmat4 world_from_object(const Json& object)
{
    const glm::dmat4 move =
        glm::translate(glm::dmat4(1), vec3_or(object, "translation", glm::dvec3(0)));
    const glm::dmat4 stretch = glm::scale(glm::dmat4(1), vec3_or(object, "scale", glm::dvec3(1)));
    return move * rotation(object) * stretch;
}

glm::dvec3 direction_or(
    const Json& value, const char* key, const glm::dvec3& fallback, const ScenePlace& place)
{
    if (!value.contains(key))
        return fallback;
    const glm::dvec3 found = vec3(value[key]);
    const double length = glm::length(found);
    if (!(length > 0))
        refuse(place / key, describe(value[key]), "a direction: not all three 0");
    return found / length;
}

std::string one_of(const std::vector<std::string>& names, const std::string& where)
{
    if (names.empty())
        return "one of " + where + ", which has none";
    std::string list = "one of ";
    for (const std::string& name : names)
        list += (&name == &names.front() ? "" : ", ") + name;
    return list;
}

}  // namespace farlight
