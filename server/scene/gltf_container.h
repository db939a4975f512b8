// The outer layers of a glTF file: GLB chunks, JSON, and the bytes of its buffers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON does not throw, its assertions look so.
struct GltfContainer {
    nlohmann::json document;  ///< Fits server/scene/gltf.schema.json.
    /// Bytes of /buffers/i, exactly its byteLength; empty for one that is a data URI.
    std::vector<std::vector<unsigned char>> buffers;
};

/// Throws SceneError for a broken container, a document that breaks the schema, a buffer's file
/// that is missing or too short. Reads no file but the buffers'.
GltfContainer open_gltf_container(const std::filesystem::path& file);

/// Whether a buffer's uri carries its bytes itself.
bool is_data_uri(std::string_view uri);

}  // namespace farlight
