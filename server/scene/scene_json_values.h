// What all parts of a Farlight scene document are made of: vectors, rotations, transforms. The
// schema has been checked.
#pragma once

#include "server/scene/scene_error.h"

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace farlight {

glm::dvec3 vec3(const nlohmann::json& value);
glm::dvec3 vec3_or(const nlohmann::json& object, const char* key, const glm::dvec3& fallback);

/// /rotation_degrees of `object`: about x, then y, then z.
glm::dmat4 rotation(const nlohmann::json& object);

/// Scale, then rotation, then translation.
glm::dmat4 world_from_object(const nlohmann::json& object);

/// `value[key]` as a unit vector, or `fallback`. Refuses one that is all 0.
glm::dvec3 direction_or(const nlohmann::json& value, const char* key, const glm::dvec3& fallback,
    const ScenePlace& place);

/// `names` as an error lists them: "one of a, b", or that `where` has none.
std::string one_of(const std::vector<std::string>& names, const std::string& where);

}  // namespace farlight
