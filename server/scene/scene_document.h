// A scene that can be edited while it is shown: its document, and the Scene that follows from it.
#pragma once

#include "server/scene/scene_file.h"

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace farlight {

/// Immutable and cheap to copy; what edits of one document read from files is kept for the next.
class SceneFiles;

class SceneDocument {
public:
    /// A Farlight scene as it is. A glTF file becomes the document {"version": 1, "objects":
    /// [{"mesh": {"file": NAME}}]} and keeps its own camera, or gets the default camera and light.
    /// Throws SceneError.
    static SceneDocument load(const std::filesystem::path& file);

    /// Equal to what load_scene() makes of the same file.
    const Scene& scene() const { return *scene_; }
    const nlohmann::json& document() const { return *document_; }

    /// The document after a JSON Merge Patch (RFC 7386): objects merge, null deletes, all else is
    /// replaced. Files that are new to the document must lie in its own folder or below. Throws
    /// SceneError, whose pointers are those of the patched document; `this` stays as it is.
    SceneDocument edited(const nlohmann::json& merge_patch) const;

private:
    SceneDocument() = default;
    /// Another document at the same place.
    SceneDocument(nlohmann::json document, const SceneDocument& before);

    std::string name_;  // of the file
    bool is_gltf_ = false;
    std::shared_ptr<SceneFiles> files_;
    std::shared_ptr<const nlohmann::json> document_;
    std::shared_ptr<const Scene> scene_;
};

}  // namespace farlight
