// The outer layers of a glTF file: GLB chunks, JSON, and the bytes of its buffers and buffer views.
#pragma once

#include "server/scene/scene_error.h"

#include <deque>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace farlight {

using ByteSpan = std::span<const unsigned char>;

// NOLINTNEXTLINE(bugprone-exception-escape): moving JSON does not throw, its assertions look so.
struct GltfContainer {
    nlohmann::json document;  ///< Fits server/scene/gltf.schema.json.
    ScenePlace root;  ///< The file, no pointer.
    std::filesystem::path folder;  ///< Where relative uris start.
    /// Bytes of /buffers/i, exactly its byteLength; empty for one that only stands in for
    /// compressed views (EXT_meshopt_compression).
    std::vector<ByteSpan> buffers;
    std::vector<ByteSpan> views;  ///< Bytes of /bufferViews/i, decompressed; see gltf_views.h.
    /// Packed elements of accessors that a primitive keeps compressed (gltf_draco.h), by index.
    std::map<std::size_t, ByteSpan> unpacked;
    std::deque<std::string> storage;  ///< What the spans point into.

    /// document[name], or an empty array.
    const nlohmann::json& list(const char* name) const;
    /// The element of list(name) that `index`, found at `place`, names. Throws SceneError.
    const nlohmann::json& item(
        const char* name, const nlohmann::json& index, const ScenePlace& place) const;

    /// Keeps `bytes` as long as the container lives.
    ByteSpan keep(std::string bytes);
};

/// `bytes` are those of `file`, which is not read. Throws SceneError for a broken container, a
/// document that breaks the schema or requires an extension that is not read, a buffer's file that
/// is missing or too short. Reads no file but the buffers'.
GltfContainer open_gltf_container(std::string bytes, const std::filesystem::path& file);

/// object["extensions"][name], or null.
const nlohmann::json* gltf_extension(const nlohmann::json& object, const char* name);

}  // namespace farlight
