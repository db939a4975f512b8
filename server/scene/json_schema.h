// Checks a document against a JSON Schema (draft-07) that we ship, and words the refusal.
#pragma once

#include "server/scene/scene_error.h"

#include <nlohmann/json.hpp>

namespace farlight {

/// Throws SceneError for the innermost value that breaks `schema_text`. What was expected is the
/// `description` of the schema's part that the value stands under: every part of it has one. It is
/// read once and must stay where it is.
void check_schema(
    const nlohmann::json& document, std::string_view schema_text, const std::string& file);

/// scenes/schema/farlight-scene.schema.json, embedded at build time.
std::string_view farlight_scene_schema();

/// server/scene/gltf.schema.json, embedded too: the part of glTF 2.0 that is read.
std::string_view gltf_schema();

}  // namespace farlight
