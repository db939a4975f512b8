// Checks a document against a JSON Schema (draft-07) that we ship, and words the refusal.
#pragma once

#include "server/scene/scene_error.h"

#include <nlohmann/json.hpp>

namespace farlight {

/// Throws SceneError for the innermost value that breaks `schema_text`. What was expected is the
/// `description` of the schema's part that the value stands under: every part of it has one.
void check_schema(
    const nlohmann::json& document, std::string_view schema_text, const std::string& file);

/// Embedded at build time.
extern const std::string_view kFarlightSceneSchema;  // scenes/farlight-scene.schema.json
extern const std::string_view kGltfSchema;  // server/scene/gltf.schema.json: what we read of it

}  // namespace farlight
